"""Looks at every page of the built site in a headless Chromium: python docs/look.py [build/site]

Each page is opened at a desktop's and at a phone's width. What is reported: formulas that MathJax couldn't set, or left
unset, or that are wider than their place on a desktop; images and links that lead nowhere; a page wider than the phone.
Nothing is fetched but from the folder.
"""

from __future__ import annotations

import argparse
import functools
import html
import json
import re
import shutil
import subprocess
import sys
import tempfile
import threading
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path

DESKTOP, PHONE = 1300, 390
REPORT = "look.html"
BROWSERS = ("chromium", "chromium-browser", "google-chrome")

LOOKER = """<!doctype html><meta charset="utf-8"><body><pre id="report">unfinished</pre><script>
const pages = %s, widths = %s, found = [];
const known = new Map();
async function there(url) {
  if (!known.has(url)) known.set(url, fetch(url, {method: "HEAD"}).then(answer => answer.ok, () => false));
  return known.get(url);
}
async function look(page, width) {
  const frame = document.createElement("iframe");
  frame.style.cssText = `width:${width}px;height:900px;border:0`;
  frame.src = page;
  document.body.append(frame);
  await new Promise(done => frame.onload = done);
  const inner = frame.contentWindow, body = inner.document;
  const say = what => found.push({page, width, what});
  if (inner.MathJax) await inner.MathJax.startup.promise;
  for (const error of body.querySelectorAll("mjx-merror")) say(`formula: ${error.textContent}`);
  for (const math of body.querySelectorAll(".math:not(:has(mjx-container, math, .math))"))
    if (math.textContent.trim()) say(`formula not set: ${math.textContent.trim().slice(0, 80)}`);
  for (const text of body.querySelectorAll("article p, article li, article td")) {
    const copy = text.cloneNode(true);
    copy.querySelectorAll("code, mjx-container, pre").forEach(part => part.remove());
    const words = copy.textContent;
    if (/\\$[^$]+\\$|\\\\(frac|partial|omega)/.test(words)) say(`formula as text: ${words.slice(0, 80)}`);
  }
  const slides = e => /auto|scroll/.test(inner.getComputedStyle(e).overflowX);
  const kept = e => e.tagName !== "ARTICLE" && (slides(e) || kept(e.parentElement));
  const heard = e => e.closest("mjx-assistive-mml");  // clipped: for who listens, not for who looks
  const beyond = e => e.getBoundingClientRect().right > width + 1 && !kept(e) && !heard(e);
  const wide = [...body.querySelectorAll("article *")].find(beyond);
  if (body.scrollWidth > width + 1) say(`the page slides: ${body.scrollWidth} px`);
  if (wide) say(`too wide: ${wide.tagName}.${wide.className} ${wide.textContent.trim().slice(0, 60)}`);
  if (width === widths[0]) {
    for (const math of body.querySelectorAll("div.math"))
      if (math.scrollWidth > math.clientWidth + 1)
        say(`formula cut off: ${math.scrollWidth} of ${math.clientWidth} px in ${math.closest("section")?.id}`);
    for (const image of body.images) {
      image.loading = "eager";
      if (!image.complete) await new Promise(done => image.onload = image.onerror = done);
      if (!image.naturalWidth) say(`image: ${image.src}`);
    }
    for (const link of body.links) {
      const [file, id] = link.href.split("#");
      if (!file.startsWith(location.origin)) continue;
      if (!await there(file)) say(`link: ${link.getAttribute("href")}`);
      if (id && file === inner.location.href.split("#")[0] && !body.getElementById(decodeURIComponent(id)))
        say(`link to nothing on the page: #${id}`);
    }
  }
  frame.remove();
}
(async () => {
  for (const width of widths)
    for (const page of pages) await look(page, width).catch(what => found.push({page, width, what: `${what}`}));
  document.getElementById("report").textContent = JSON.stringify({pages: pages.length, found});
})();
</script>"""


class Quiet(SimpleHTTPRequestHandler):
    """Serves the folder and says nothing of it."""

    def log_message(self, format: str, *args: object) -> None:  # noqa: A002
        """Nothing."""


def look(site: Path, browser: str, seconds: int, only: str = "") -> dict:
    """What the browser found, page by page, on pages whose names contain `only`."""
    pages = sorted(page.relative_to(site).as_posix() for page in site.rglob("*.html"))
    pages = [
        page for page in pages if not page.startswith("_") and page not in (REPORT, "search.html") and only in page
    ]
    (site / REPORT).write_text(LOOKER % (json.dumps(pages), json.dumps([DESKTOP, PHONE])), encoding="utf-8")
    server = ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Quiet, directory=str(site)))
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        with tempfile.TemporaryDirectory() as profile:
            command = [
                browser, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}",
                "--disable-dev-shm-usage", f"--timeout={seconds * 1000}", f"--virtual-time-budget={seconds * 1000}",
                "--dump-dom", f"http://127.0.0.1:{server.server_port}/{REPORT}",
            ]  # fmt: skip
            page = subprocess.run(command, capture_output=True, encoding="utf-8", timeout=seconds, check=False).stdout
    finally:
        server.shutdown()
        (site / REPORT).unlink()
    report = re.search(r'<pre id="report">(.*?)</pre>', page, re.DOTALL)
    if report is None or report[1] == "unfinished":
        raise SystemExit(f"{browser} didn't finish")
    return json.loads(html.unescape(report[1]))


def main() -> int:
    """Print what was found; 1 if there is anything, 0 if not or if there is no browser."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("site", nargs="?", type=Path, default=Path("build/site"))
    parser.add_argument("--seconds", type=int, default=300, help="time for the browser")
    parser.add_argument("--only", default="", help="pages whose names contain this")
    arguments = parser.parse_args()
    browser = next(filter(None, map(shutil.which, BROWSERS)), None)
    if browser is None:
        print("no Chromium here: the pages were not looked at")
        return 0
    report = look(arguments.site, browser, arguments.seconds, arguments.only)
    for each in report["found"]:
        print(f"{each['page']} at {each['width']} px: {each['what']}")
    print(f"{report['pages']} pages at {DESKTOP} and {PHONE} px: {len(report['found'])} faults")
    return bool(report["found"])


if __name__ == "__main__":
    sys.exit(main())
