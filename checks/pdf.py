"""What a PDF claims to be, and whether it is: tags, alternative texts, language, fonts, colours (PDF/A-2a, PDF/UA-1).

No validator of the whole standards is to be had without Java, so this looks at the file itself with pikepdf, and lets
pdfua, which is independent of this project, judge the part of PDF/UA-1 that it knows. Usage: pdf.py FILE...
"""

import re
import sys

import pdfua
import pikepdf

# Elements of the structure tree that a reader cannot see and must be told about.
NEEDS_WORDS = ("/Figure", "/Formula")
# What may run or fetch something; an archived document does neither.
ACTIVE = ("/JavaScript", "/JS", "/Launch", "/SubmitForm", "/ImportData", "/Movie", "/Sound", "/Rendition")


def elements(node, found):
    """Every element below a node of the structure tree, in reading order."""
    if isinstance(node, pikepdf.Array):
        for child in node:
            elements(child, found)
    elif isinstance(node, pikepdf.Dictionary):
        if "/S" in node:
            found.append(node)
        if "/K" in node:
            elements(node.K, found)
    return found


def problems_of_metadata(pdf):
    """Claims of the XMP packet against the trailer and the catalogue."""
    root = pdf.Root
    with pdf.open_metadata() as xmp:
        claims = {name: xmp.get(name) for name in ("pdfaid:part", "pdfaid:conformance", "pdfuaid:part", "dc:title")}
    wanted = {"pdfaid:part": "2", "pdfaid:conformance": "A", "pdfuaid:part": "1"}
    for name, value in wanted.items():
        if claims[name] != value:
            yield f"XMP: {name} is {claims[name]!r}, not {value!r}"
    if not claims["dc:title"]:
        yield "XMP: no title"
    if not root.get("/ViewerPreferences", {}).get("/DisplayDocTitle", False):
        yield "the window would not show the title"
    if not str(root.get("/Lang", "")):
        yield "no language"
    if not root.get("/MarkInfo", {}).get("/Marked", False):
        yield "MarkInfo does not say that the document is tagged"
    if pdf.is_encrypted:
        yield "encrypted"
    intents = root.get("/OutputIntents", [])
    if not any(intent.get("/S") == "/GTS_PDFA1" and "/DestOutputProfile" in intent for intent in intents):
        yield "no output intent with a colour profile"


def problems_of_tags(pdf, counts):
    """The structure tree: there, and with words where a reader needs them."""
    if "/StructTreeRoot" not in pdf.Root:
        yield "no structure tree"
        return
    for element in elements(pdf.Root.StructTreeRoot.K, []):
        kind = str(element.S)
        counts[kind] = counts.get(kind, 0) + 1
        words = str(element.get("/Alt", "")).strip()
        if kind in NEEDS_WORDS and len(words) < 1:
            yield f"{kind} number {counts[kind]} has no alternative text"
        if kind == "/Figure" and len(words) < 30:
            yield f"/Figure number {counts[kind]}: {words!r} does not say what is seen"
    for kind in ("/Figure", "/Caption", "/H1", "/P"):
        if kind not in counts:
            yield f"no {kind} in the structure tree"
    for number, page in enumerate(pdf.pages, 1):
        if "/StructParents" not in page and "/Contents" in page:
            yield f"page {number} is not tied to the structure tree"
        if page.get("/Tabs") != "/S":
            yield f"page {number}: the order of tabs is not that of the structure"


def problems_of_objects(pdf, counts):
    """Fonts that are not embedded or whose text cannot be copied, smoothed pictures, anything that acts."""
    for item in pdf.objects:
        if not isinstance(item, (pikepdf.Dictionary, pikepdf.Stream)):
            continue
        kind = str(item.get("/Type", ""))
        if kind == "/FontDescriptor":
            counts["fonts"] = counts.get("fonts", 0) + 1
            if not any(key in item for key in ("/FontFile", "/FontFile2", "/FontFile3")):
                yield f"font {item.get('/FontName')} is not embedded"
        if kind == "/Font" and str(item.get("/Subtype")) in ("/Type0", "/TrueType") and "/ToUnicode" not in item:
            yield f"font {item.get('/BaseFont')}: its text cannot be copied"
        if str(item.get("/Subtype", "")) == "/Image" and item.get("/Interpolate", False):
            yield "a picture is smoothed by the viewer"
        if str(item.get("/S", "")) in ACTIVE or "/JS" in item:
            yield f"something acts: {item.get('/S')}"
        if str(item.get("/Subtype", "")) == "/Link" and not str(item.get("/Contents", "")).strip():
            yield "a link without words"


def check(path):
    """The number of problems of a file, which are printed."""
    counts = {}
    with pikepdf.open(path) as pdf:
        found = list(problems_of_metadata(pdf)) + list(problems_of_tags(pdf, counts)) + list(problems_of_objects(pdf, counts))
        pages = len(pdf.pages)
    report = pdfua.validate(path)
    found += [f"pdfua: {finding}" for finding in report.findings]
    for problem in sorted(set(found)):
        print(f"{path}: {problem}", file=sys.stderr)
    if not found:
        words = ", ".join(f"{counts.get(kind, 0)} {re.sub('/', '', kind)}" for kind in (*NEEDS_WORDS, "/Table", "fonts"))
        print(f"{path}: PDF/A-2a and PDF/UA-1 as far as is looked at: {pages} pages, {words}; no problem")
    return len(found)


def first(pdf, kind):
    return next(element for element in elements(pdf.Root.StructTreeRoot.K, []) if element.S == kind)


def drop_font(pdf):
    descriptor = next(item for item in pdf.objects if isinstance(item, pikepdf.Dictionary) and item.get("/Type") == "/FontDescriptor")
    for key in ("/FontFile", "/FontFile2", "/FontFile3"):
        if key in descriptor:
            del descriptor[key]


def drop_claim(pdf):
    with pdf.open_metadata(set_pikepdf_as_editor=False) as xmp:
        del xmp["pdfuaid:part"]


def drop(item, key):
    del item[key]


# Each makes a document that is not what it claims to be.
DAMAGES = {
    "a figure without words": lambda pdf: drop(first(pdf, "/Figure"), "/Alt"),
    "a formula without words": lambda pdf: drop(first(pdf, "/Formula"), "/Alt"),
    "no language": lambda pdf: drop(pdf.Root, "/Lang"),
    "no mark of being tagged": lambda pdf: drop(pdf.Root, "/MarkInfo"),
    "no structure": lambda pdf: drop(pdf.Root, "/StructTreeRoot"),
    "no output intent": lambda pdf: drop(pdf.Root, "/OutputIntents"),
    "a font that is not embedded": drop_font,
    "no claim": drop_claim,
    "a script": lambda pdf: pdf.Root.update({"/OpenAction": pdf.make_indirect(pikepdf.Dictionary(S=pikepdf.Name.JavaScript, JS="1"))}),
}


def prove(path):
    """The number of damages that the check does not see; on copies of a file that is well."""
    missed = 0
    for name, damage in DAMAGES.items():
        with pikepdf.open(path) as pdf:
            damage(pdf)
            found = [*problems_of_metadata(pdf), *problems_of_tags(pdf, {}), *problems_of_objects(pdf, {})]
        if not found:
            print(f"not seen: {name}", file=sys.stderr)
            missed += 1
    print(f"{len(DAMAGES) - missed} of {len(DAMAGES)} damages seen")
    return missed


if __name__ == "__main__":
    paths = sys.argv[1:]
    sys.exit(1 if sum(check(path) for path in paths) or sum(prove(path) for path in paths[:1]) else 0)
