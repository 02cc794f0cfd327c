"""Equations of doc/theory: numbered, and traced to the function that computes them and to a test that proves them.

  equations.py ROOT          checks, and prints every gap; exit status 1 if there is one
  equations.py --self-test   plants one gap of each kind in a copy of a small page and wants each of them found

doc/theory/equations.md has the table: page, number, source, name of the function or member in it, file of the test, name of the test. A source
cites the page. Every equation has at least one row.
"""
import pathlib
import re
import sys
import tempfile

TABLE = "doc/theory/equations.md"
ROW = re.compile(r"^\| \[([\w-]+)\]\([\w-]+\.md\) \| (\d+) \| `([^`]+)` \| `([^`]+)` \| `([^`]+)` \| (.+) \|$")


def displayed(text):
    """Display equations, of either notation."""
    return re.findall(r"^ *```math\n(.*?)\n *```$|^\$\$(.+?)\$\$$", text, re.M | re.S)


def numbers_of(page, text, gaps):
    found = []
    for fenced, dollars in displayed(text):
        tags = [int(n) for n in re.findall(r"\\tag\{(\d+)\}", fenced or dollars)]
        wanted = len(found) + 1
        if tags != [wanted]:
            gaps.append(f"{page}.md: equation {wanted} is tagged {tags}, where \\tag{{{wanted}}} is expected")
        found.append(wanted)
    return found


def joined(source):
    """A source whose adjacent string literals are one, as the compiler has them."""
    return re.sub(r'"\s*\n\s*"', "", source)


def check_row(root, page, number, source, symbol, test_file, test, gaps):
    where = f"{TABLE}: {page} ({number})"
    code = root / source
    if not code.is_file():
        gaps.append(f"{where}: there is no {source}")
    else:
        text = code.read_text()
        if not re.search(rf"\b{re.escape(symbol)}\b", text):
            gaps.append(f"{where}: {source} has no {symbol}")
        if f"doc/theory/{page}.md" not in text:
            gaps.append(f"{where}: {source} does not cite doc/theory/{page}.md")
    proof = root / test_file
    if not proof.is_file():
        gaps.append(f"{where}: there is no {test_file}")
    elif f'"{test}"' not in joined(proof.read_text()):
        gaps.append(f'{where}: {test_file} has no test "{test}"')


def check(root):
    gaps, numbered, traced = [], set(), set()
    for path in sorted((root / "doc/theory").glob("*.md")):
        numbered.update((path.stem, number) for number in numbers_of(path.stem, path.read_text(), gaps))
    for line in (root / TABLE).read_text().splitlines():
        row = ROW.match(line)
        if row:
            page, number, *others = row.groups()
            traced.add((page, int(number)))
            check_row(root, page, number, *others, gaps)
        elif line.startswith("| [") or line.startswith("- ["):
            gaps.append(f"{TABLE}: cannot be read: {line}")
    for page, number in sorted(numbered - traced):
        gaps.append(f"{TABLE}: says nothing of {page} ({number})")
    for page, number in sorted(traced - numbered):
        gaps.append(f"{TABLE}: {page} has no equation ({number})")
    return gaps, len(numbered)


PAGE = "# A spring\n\n```math\nF = k\\,u\n\\tag{1}\n```\n\n```math\nU = \\tfrac12 k\\,u^2\n\\tag{2}\n```\n"
CODE = "/** doc/theory/spring.md */\ndouble force(double u);\n"
TEST = 'TEST_CASE("a spring pulls as far as "\n          "it is stretched", "[x]")\n'
LINE = "| [spring](spring.md) | 1 | `spring.h` | `force` | `spring.cc` | a spring pulls as far as it is stretched |\n"
REST = LINE.replace("| 1 |", "| 2 |")


def gaps_in(page=PAGE, code=CODE, test=TEST, table=LINE + REST):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "doc/theory").mkdir(parents=True)
        (root / "doc/theory/spring.md").write_text(page)
        (root / TABLE).write_text(table)
        (root / "spring.h").write_text(code)
        (root / "spring.cc").write_text(test)
        return check(root)[0]


def self_test():
    planted = {
        "has no force": dict(code=CODE.replace("force", "forces")),
        "does not cite": dict(code=CODE.replace("spring.md", "other.md")),
        "has no test": dict(test=TEST.replace("pulls", "pushes")),
        "is tagged [2]": dict(page=PAGE.replace("\\tag{1}", "\\tag{2}")),
        "is tagged []": dict(page=PAGE.replace("\n\\tag{2}", "")),
        "says nothing of spring (2)": dict(table=LINE),
        "has no equation (3)": dict(table=LINE + REST + LINE.replace("| 1 |", "| 3 |")),
        "cannot be read": dict(table=LINE.replace("| 1 |", "| one |") + REST),
        "cannot be read: - [spring]": dict(table=LINE + "- [spring](spring.md): 2\n"),
    }
    if gaps_in():
        sys.exit(f"a page without a gap: {gaps_in()}")
    for words, change in planted.items():
        if not any(words in gap for gap in gaps_in(**change)):
            sys.exit(f'not found: "{words}"; instead {gaps_in(**change)}')


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    gaps, equations = check(pathlib.Path(sys.argv[1]))
    print(*gaps, sep="\n")
    print(f"{equations} equations, traced to code and test; {len(gaps)} gaps")
    return sys.exit(1 if gaps else 0)


main()
