import importlib
import pkgutil
import subprocess
import sys

import canon
from canon.homes import HOMES


def test_importing_canon_does_not_import_sympy():
    code = "import sys, canon; canon.__version__; print('sympy' in sys.modules)"
    answer = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)  # noqa: S603
    assert answer.stdout.strip() == "False"


def test_every_public_name_is_there_and_documented():
    for name in canon.__all__:
        value = getattr(canon, name)
        assert name.startswith("_") or isinstance(value, canon.Conventions) or value.__doc__, name


def test_the_lists_of_names_agree():
    homes = {name: module for module, names in HOMES.items() for name in names}
    assert {*homes, "__version__"} == {*canon.__all__}
    for name, module in homes.items():
        assert getattr(importlib.import_module(module), name) is getattr(canon, name)


def test_no_module_stands_where_a_public_name_is_meant():
    """Once a submodule is imported, it is an attribute of its package: `hamiltonians` was a module then."""
    import canon.testing

    for package in (canon, canon.testing):
        modules = {module.name for module in pkgutil.iter_modules(package.__path__)}
        assert not modules & {*package.__all__}
