"""``rgss variants``: the design space, expanded."""

from __future__ import annotations

import argparse

from rgss.cli.options import add_study, chosen_project

HELP = "list every design variant with its parameters"
EXAMPLE = "rgss variants --format csv > variants.csv"


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_study(parser)
    parser.add_argument("--format", choices=("table", "csv", "json"), default="table", help="how to list them")


def run(options: argparse.Namespace) -> int:
    """List the variants."""
    import sys

    from rgss.cli.output import print_json, print_table
    from rgss.designs import variants_csv

    variants = chosen_project(options).designs.expand()
    if options.json or options.format == "json":
        print_json([{"id": variant.id, "parameters": dict(variant.columns())} for variant in variants])
    elif options.format == "csv":
        sys.stdout.write(variants_csv(variants))
    else:
        titles = ["id", *variants[0].columns()] if variants else ["id"]
        rows = [
            [str(variant.id), *(f"{v:g}" if isinstance(v, float) else str(v) for v in variant.columns().values())]
            for variant in variants
        ]
        print_table(titles, rows, right=range(len(titles)))
    return 0
