"""``rgss variants``: the design space, expanded."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from typing import TYPE_CHECKING

from rgss.cli.options import add_study, chosen_project
from rgss.reports.variants import VARIANT_FORMATS, variant_format, variant_table_lines

if TYPE_CHECKING:
    from rgss.designs import DesignSpace

HELP = "list every design variant with its parameters"
ONLY_HELP = (
    "only these variants: ids such as 1,5,60-72, filters such as planning.planner=RRT or "
    "'robot.tool_speed <= 0.8 m/s', or a balanced fraction such as 1/4; given several times, all must hold, in order"
)
PAGED = True
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
    parser.add_argument(
        "--format", choices=[one.name for one in VARIANT_FORMATS], default="table", help="the output format"
    )


def run(options: argparse.Namespace) -> int:
    """List the variants."""
    from rgss.cli.output import print_lines
    from rgss.cli.safe_output import data_stream
    from rgss.designs import picked

    designs = chosen_project(options).designs
    variants = picked(designs, options.only or ())
    chosen = variant_format("json" if options.json else options.format)
    if chosen.name == "table":
        print_lines(variant_table_lines(designs, variants))
    else:
        stream = data_stream() if chosen.is_data else sys.stdout
        for text in chosen.write(designs, variants):
            stream.write(text)
    for line in _left_out(designs):
        print(f"rgss: {line}", file=sys.stderr)
    return 0


def _left_out(designs: DesignSpace) -> list[str]:
    """Lines on the sampled points and combinations that make no variant; empty if there are none."""
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
