"""``rgss variants``: the design space, expanded."""

from __future__ import annotations

import argparse
from collections import Counter
from typing import TYPE_CHECKING

from rgss.cli.options import add_study, chosen_project

if TYPE_CHECKING:
    from rgss.designs import DesignSpace

HELP = "list every design variant with its parameters"
ONLY_HELP = (
    "only these variants: ids such as 1,5,60-72, filters such as planning.planner=RRT or "
    "'robot.tool_speed <= 0.8 m/s', or a balanced fraction such as 1/4; given several times, all must hold, in order"
)
EXAMPLE = "rgss variants --format csv > variants.csv"
MORE_EXAMPLES = (
    (
        "rgss variants --only planning.planner=RRT --only 'robot.tool_speed <= 0.8 m/s'",
        "those of both filters",
    ),
    ("rgss variants --only 1/4", "a balanced quarter of them"),
)


def configure(parser: argparse.ArgumentParser) -> None:
    """Add the verb's options."""
    add_study(parser)
    parser.add_argument("--only", action="append", metavar="WHICH", help=ONLY_HELP)
    parser.add_argument("--format", choices=("table", "csv", "json"), default="table", help="how to list them")


def run(options: argparse.Namespace) -> int:
    """List the variants."""
    import sys

    from rgss.cli.output import print_json
    from rgss.cli.safe_output import data_stream
    from rgss.cli.variants_table import print_variants
    from rgss.designs import picked, variants_csv

    designs = chosen_project(options).designs
    variants = picked(designs, options.only or ())
    if options.json or options.format == "json":
        print_json([{"id": variant.id, "parameters": dict(variant.columns())} for variant in variants])
    elif options.format == "csv":
        data_stream().write(variants_csv(variants))
    else:
        print_variants(designs, variants)
    for line in _left_out(designs):
        print(f"rgss: {line}", file=sys.stderr)
    return 0


def _left_out(designs: DesignSpace) -> list[str]:
    """What was looked at and makes no variant; nothing where all of it does."""
    lines = []
    if designs.sample is not None:
        sample = designs.sample
        repeats = f", {len(sample.repeats)} of them repeat another" if sample.repeats else ""
        lines.append(f"{sample.size} points sampled by {sample.method.value} with seed {sample.seed}{repeats}")
    excluded = designs.excluded()
    if excluded:
        counts = Counter(rule for one in excluded for rule in one.rules)
        rules = ", ".join(f"{rule} {counts[rule]}" for rule in (one.id for one in designs.rules) if rule in counts)
        lines.append(f"{len(excluded)} combinations make no design, by rule: {rules}")
    return lines
