#!/usr/bin/env python3
"""Every notebook of doc/notebooks runs from its first cell to its last, which compares it with the program to the last bit.

    notebooks_test.py FOLDER_OF_MODULE PROGRAM ROOT

What they have shown is left in notebooks/ of the module's folder: `./breccia doc` shows it too. Leaves with status 77, which the tests count
as skipped, where the module or one of the packages is not there.
"""
import os
import pathlib
import sys
import unittest

folder_of_module, program, root = sys.argv[1:4]
sys.path.insert(0, folder_of_module)
try:
    import ipykernel  # noqa: F401
    import matplotlib  # noqa: F401
    import nbclient
    import nbformat
    import scipy  # noqa: F401

    import breccia  # noqa: F401
except ImportError as missing:
    print(f"skipped: {missing}; ./breccia python builds the module and installs what notebooks need (python/packages.txt)")
    sys.exit(77)

FOLDER = pathlib.Path(root, "doc", "notebooks")
SHOWN = pathlib.Path(folder_of_module, "notebooks")


class NotebookTest(unittest.TestCase):
    def test_there_are_ten_without_outputs(self):
        books = sorted(FOLDER.glob("*.ipynb"))
        self.assertGreaterEqual(len(books), 10)
        for path in books:
            with self.subTest(path.name):
                self.assertLess(path.stat().st_size, 10_000)
                for cell in nbformat.read(path, as_version=4).cells:
                    self.assertFalse(cell.get("outputs"))
                    self.assertIsNone(cell.get("execution_count"))

    def execute(self, path):
        book = nbformat.read(path, as_version=4)
        nbformat.validate(book)
        self.assertIn("by_the_program.", book.cells[-1].source)  # it ends with the comparison
        self.assertIn("assert", book.cells[-1].source)
        nbclient.NotebookClient(book, timeout=300, resources={"metadata": {"path": str(FOLDER)}}).execute()
        for cell in book.cells:
            cell.metadata = {}
        SHOWN.mkdir(exist_ok=True)
        nbformat.write(book, SHOWN / path.name)


def test_of(path):
    return lambda self: self.execute(path)


for path in FOLDER.glob("*.ipynb"):
    setattr(NotebookTest, f"test_{path.stem}", test_of(path))


if __name__ == "__main__":
    os.environ["PYTHONPATH"] = folder_of_module
    os.environ["BRECCIA_PROGRAM"] = program
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"
    os.environ["PYTHONDONTWRITEBYTECODE"] = "1"
    unittest.main(argv=sys.argv[:1] + sys.argv[4:])
