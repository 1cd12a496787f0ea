"""The command line: one module a command, entered through `canon.cli.main`."""
