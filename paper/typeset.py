"""Takes the arguments of `typst compile` and sets the document with the wheel of the same version."""

import argparse
import sys

import typst


def main() -> int:
    parser = argparse.ArgumentParser()
    parser.add_argument("verb", choices=["compile"])
    parser.add_argument("source")
    parser.add_argument("output")
    parser.add_argument("--root", required=True)
    parser.add_argument("--font-path", required=True)
    parser.add_argument("--ignore-system-fonts", action="store_true")
    parser.add_argument("--creation-timestamp", type=int, required=True)
    parser.add_argument("--pdf-standard", required=True)
    parser.add_argument("--input", action="append", default=[], metavar="NAME=VALUE")
    given = parser.parse_args()
    try:
        pdf, warnings = typst.compile_with_warnings(
            given.source,
            root=given.root,
            font_paths=[given.font_path],
            ignore_system_fonts=given.ignore_system_fonts,
            sys_inputs=dict(pair.split("=", 1) for pair in given.input),
            format="pdf",
            pdf_standards=given.pdf_standard.split(","),
            timestamp=given.creation_timestamp,
        )
    except typst.TypstError as error:
        print(error.diagnostic, file=sys.stderr)
        return 1
    for warning in warnings:
        print(warning.diagnostic, file=sys.stderr)
    with open(given.output, "wb") as file:
        file.write(pdf)
    return 0


if __name__ == "__main__":
    sys.exit(main())
