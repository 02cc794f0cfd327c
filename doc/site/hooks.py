"""What MkDocs does not know of these pages: their order, what lies outside doc/, and the pictures of the tutorials.

The order is that of the tables in doc/tutorials/README.md and doc/theory/README.md, so that a new page is entered in one place only.
"""

import json
import os
import re

from mkdocs.structure.files import File

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))
KATEX = "/usr/share/javascript/katex"
SCRIPTS = ("katex.min.css", "katex.min.js", "contrib/auto-render.js")
OF_PYTHON = ("python.md", "notebooks.md")  # tutorials with a tab of their own
OUTSIDE = {"CONTRIBUTING.md": "contributing.md", "CHANGELOG.md": "changelog.md"}
# Formulas as the pages have them, in the notation that GitHub and GitLab share.
INLINE = re.compile(r"\$`([^`]+)`\$")
DISPLAY = re.compile(r"^```math\n(.*?)\n```", re.M | re.S)
LINK = re.compile(r"(\]\()([^)\s#]+)(#[^)\s]*)?(\))")


def text_of(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def tables_of(path):
    """Headings of a page's tables, and the pages that each names in its first column, with what it says of them."""
    tables = []
    for line in text_of(path).splitlines():
        if head := re.match(r"\| (.+?) \|(?: .*\|)? *$", line):
            if row := re.match(r"\| \[[^\]]*\]\(([\w./-]+\.md)[^)]*\) \| (.*) \|", line):
                if tables:
                    tables[-1][1].append(row.groups())
            elif not line.startswith("| ---"):
                tables.append((head.group(1).strip(), []))
    return [table for table in tables if table[1]]


def title_of(path):
    found = re.search(r"^# (.+)$", text_of(path), re.M)
    return re.sub(r"[`*]", "", found.group(1)) if found else os.path.basename(path)


def title_of_notebook(name):
    return "".join(json.loads(text_of(f"doc/notebooks/{name}.ipynb"))["cells"][0]["source"]).splitlines()[0].lstrip("# ")


def pages_of(folder, tables):
    return [{name[0].upper() + name[1:]: [{title_of(f"doc/{folder}/{page}"): f"{folder}/{page}"} for page, _ in pages if page not in OF_PYTHON]}
            for name, pages in tables]


def notebooks():
    """Names of the notebooks, in the order of the table in doc/tutorials/notebooks.md."""
    return re.findall(r"^\| \[[^\]]*\]\(\.\./notebooks/(\w+)\.ipynb\)", text_of("doc/tutorials/notebooks.md"), re.M)


def shown(name, book):
    """Outputs of each cell of a notebook, from where its test has left them; none where that ran another one or not at all."""
    try:
        ran = json.loads(text_of(f"build/release/python/notebooks/{name}.ipynb"))
    except FileNotFoundError:
        return [[] for _ in book["cells"]]
    if [cell["source"] for cell in ran["cells"]] != [cell["source"] for cell in book["cells"]]:
        return [[] for _ in book["cells"]]
    return [cell.get("outputs", []) for cell in ran["cells"]]


def page_of_notebook(name):
    """A notebook as a page."""
    book = json.loads(text_of(f"doc/notebooks/{name}.ipynb"))
    out = []
    for cell, outputs in zip(book["cells"], shown(name, book)):
        source = "".join(cell["source"])
        out.append(source if cell["cell_type"] == "markdown" else f"```python\n{source}\n```")
        for output in outputs:
            data = output.get("data", {})
            if output.get("name") == "stderr":
                continue
            if "image/png" in data:
                out.append(f'<img src="data:image/png;base64,{data["image/png"].strip()}" alt="">')
            elif said := "".join(output.get("text", data.get("text/plain", ""))).rstrip():
                out.append(f"```text\n{said}\n```")
    return "\n\n".join(out) + f"\n\n[The notebook]({name}.ipynb.txt) itself stands in `doc/notebooks`.\n"


def on_config(config):
    tutorials = pages_of("tutorials", tables_of("doc/tutorials/README.md"))
    theory = pages_of("theory", tables_of("doc/theory/README.md"))
    of_python = [{title_of_notebook(name): f"notebooks/{name}.md"} for name in notebooks()]
    config.nav = [{"Breccia": "index.md"}, {"Tutorials": ["tutorials/README.md", *tutorials]},
                  {"Theory": ["theory/README.md", *theory, {"Equations": "theory/equations.md"}]},
                  {"Python": ["tutorials/python.md", {"Notebooks": ["tutorials/notebooks.md", *of_python]}]},
                  {"Parameters": "parameters.md"}, {"Files": "formats.md"}, {"Validation": "validation.md"}, {"Hard cases": "hard-cases.md"},
                  {"Contributing": "contributing.md"}, {"Changes": "changelog.md"}]
    return config


def generated(files, config, uri, text):
    """A page that is no file below doc/."""
    folder = os.path.join(ROOT, "build", "site-pages")
    path = os.path.join(folder, uri)
    os.makedirs(os.path.dirname(path), exist_ok=True)
    with open(path, "w", encoding="utf-8") as file:
        file.write(text)
    files.append(File(uri, folder, config.site_dir, config.use_directory_urls))


def copied(files, config, folder, uri, name):
    """A file that is not below doc/, as it is."""
    found = File(name, folder, config.site_dir, config.use_directory_urls)
    found.src_uri = found.dest_uri = found.url = uri
    found.abs_dest_path = os.path.join(config.site_dir, uri)
    files.append(found)


def on_files(files, config):
    for file in [f for f in files if f.src_path.endswith((".py", ".ipynb")) or f.src_path.startswith("site/theme/")]:
        files.remove(file)
    for name in notebooks():
        generated(files, config, f"notebooks/{name}.md", page_of_notebook(name))
        copied(files, config, ROOT + "/doc/notebooks", f"notebooks/{name}.ipynb.txt", f"{name}.ipynb")
    generated(files, config, "index.md", text_of("README.md"))
    for source, page in OUTSIDE.items():
        generated(files, config, page, text_of(source))
    copied(files, config, ROOT, "citation.txt", "CITATION.cff")
    for script in SCRIPTS:
        copied(files, config, KATEX, "katex/" + os.path.basename(script), script)
    for font in sorted(os.listdir(KATEX + "/fonts")):
        copied(files, config, KATEX, "katex/fonts/" + font, "fonts/" + font)
    for scene in sorted(os.listdir(ROOT + "/apps/scenes")):
        if scene.endswith(".prm"):
            copied(files, config, ROOT + "/apps/scenes", "scenes/" + scene + ".txt", scene)
    return files


def picture_of(page):
    """The first picture of a tutorial, from doc/."""
    found = re.search(r"!\[[^\]]*\]\(\.\./([^)]+)\)", text_of("doc/tutorials/" + page))
    return found.group(1) if found else None


def cards():
    """The page of tutorials: those with a picture as cards, all others as a list."""
    out = []
    for name, pages in tables_of("doc/tutorials/README.md"):
        out.append(f"\n## {name[0].upper() + name[1:]}\n")
        shown = [(page, says, picture_of(page)) for page, says in pages]
        out.append('<div class="cards">')
        for page, says, picture in shown:
            if picture:
                target = page[:-3] + ".html"
                out.append(f'<a href="{target}"><img src="../{picture}" alt="" loading="lazy">'
                           f"<strong>{title_of('doc/tutorials/' + page)}</strong>{says}</a>")
        out.append("</div>\n")
        out += [f"- [{title_of('doc/tutorials/' + page)}]({page}): {says}" for page, says, picture in shown if not picture]
    return "\n".join(out)


def page_of(path):
    """Where a file of the source tree is on the site; None where it is not on it."""
    if path.startswith("doc/notebooks/") and path.endswith(".ipynb"):
        return path[len("doc/"):-len("ipynb")] + "md"
    if path.startswith("doc/"):
        return path[len("doc/"):]
    if path.startswith("apps/scenes/") and path.endswith(".prm"):
        return "scenes/" + os.path.basename(path) + ".txt"
    if path == "CITATION.cff":
        return "citation.txt"
    return OUTSIDE.get(path, "index.md" if path == "README.md" else None)


def on_page_markdown(markdown, page, config, files):
    here = os.path.dirname(page.file.src_path)
    of_root = page.file.src_path in ("index.md", *OUTSIDE.values())

    def rewritten(match):
        start, target, anchor, end = match.groups()
        path = page_of(os.path.normpath(os.path.join("" if of_root else os.path.join("doc", here), target)))
        if "://" in target or path is None:
            return match.group(0)
        return start + os.path.relpath(path, here or ".") + (anchor or "") + end

    markdown = LINK.sub(rewritten, markdown)
    markdown = INLINE.sub(lambda m: "$" + m.group(1).strip() + "$", markdown)
    markdown = DISPLAY.sub(lambda m: "$$\n" + m.group(1) + "\n$$", markdown)
    if page.file.src_path == "tutorials/README.md":
        markdown = re.sub(r"\n\|.*", "", markdown) + "\n" + cards()
    return markdown


def on_post_build(config):
    """What a page that is opened as a file needs for its search, as one script: browsers let it read nothing else."""
    site = config.site_dir
    with open(os.path.join(site, "search", "search_index.json"), encoding="utf-8") as file:
        index = file.read()
    workers = os.path.join(site, "assets", "javascripts", "workers")
    name = next(name for name in os.listdir(workers) if name.endswith(".js"))
    with open(os.path.join(workers, name), encoding="utf-8") as file:
        worker = file.read()
    with open(os.path.join(site, "search", "offline.js"), "w", encoding="utf-8") as file:
        file.write(f"""var __search = {{ index: Promise.resolve({index}) }}
var Worker = class extends window.Worker {{
  constructor() {{ super(URL.createObjectURL(new Blob([{json.dumps(worker)}], {{ type: "text/javascript" }}))) }}
}}
""")
