"""The decision as a section in Markdown, and its place between two markers of a file."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from rgss.cli.trade.words import amount, ids_text, moves_text, percent, variants_text
from rgss.invisible_characters import visible

if TYPE_CHECKING:
    from rgss.assessment import VariantMeasures
    from rgss.decision.robustness import Robustness
    from rgss.studies import Project
    from rgss.tradeoff import Decision

BEGIN = "<!-- decision: written by `rgss trade --section --into FILE`; do not edit -->"
END = "<!-- end of decision -->"


def decision_section(
    project: Project, measured: Sequence[VariantMeasures], decision: Decision, found: Robustness
) -> str:
    """The decision, what decides it, and whether the assumed costs matter, between its markers.

    Args:
        project: The project with its study.
        measured: Every variant with its estimates.
        decision: What was decided.
        found: How robust it is.
    """
    from rgss.decision.robustness import not_computed_lines

    parts = [BEGIN, ""]
    if decision.chosen is None:
        parts += [f"No variant of study `{project.study.id}` meets every requirement.", ""]
    else:
        parts += [*_choice(project, measured, decision), ""]
        parts += [*_deciding(decision, found), ""]
        parts += [*_costs(found), ""]
    for line in not_computed_lines(found.not_computed):
        parts += [line, ""]
    return visible("\n".join([*parts, END]))


def text_with_place(file: Path) -> str:
    """The text of a file that has a place for the section.

    Args:
        file: The file.

    Raises:
        DefinitionError: The file cannot be read, or has not each marker once.
    """
    from rgss.documents import LARGEST_FILE_BYTES, chunks_of
    from rgss.errors import DefinitionError

    try:
        text = b"".join(chunks_of(file, largest=LARGEST_FILE_BYTES)).decode(
            "utf-8"
        )  # with its ends of lines, which stay
    except (OSError, ValueError) as error:
        raise DefinitionError(f"{str(file)!r} cannot be read", hint="name a Markdown file") from error
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise DefinitionError(
            f"{str(file)!r} has no place for the decision", hint=f"write {BEGIN!r} and, below it, {END!r}"
        )
    return text


def with_section(text: str, section: str) -> str:
    """A text with another section between its markers.

    Args:
        text: A text that has each marker once.
        section: The section with its markers.
    """
    ended = section.replace("\n", "\r\n") if "\r\n" in text else section
    return text.partition(BEGIN)[0] + ended + text.partition(END)[2]


def _choice(project: Project, measured: Sequence[VariantMeasures], decision: Decision) -> Iterator[str]:
    by_id = {entry.variant.id: entry for entry in measured}
    shown = [variant for variant in (decision.chosen, decision.runner_up) if variant is not None]
    trials = sum(len(entry.records) for entry in measured)
    ties = f" ({variants_text(decision.ties[1:])} are as good)" if len(decision.ties) > 1 else ""
    yield (
        f"**Variant {decision.chosen}** is chosen{ties} from {len(measured)} variants with {trials} trials; "
        f"{decision.counts.feasible} of them meet every requirement."
    )
    yield ""
    yield f"| | weight | {' | '.join(['chosen', 'runner-up'][: len(shown)])} |"
    yield "|---|---|" + "---|" * len(shown)
    yield f"| variant | | {' | '.join(str(variant) for variant in shown)} |"
    for definition in project.designs.parameters:
        if len({str(entry.variant.parameters[definition.id]) for entry in measured}) > 1:
            cells = [_parameter(by_id[one].variant.parameters[definition.id], definition.unit) for one in shown]
            yield f"| {definition.name.replace('_', ' ')} | | {' | '.join(cells)} |"
    for measure, weight in project.study.trade_off.weighting.weights.items():
        estimates = [by_id[variant].estimates[measure] for variant in shown]
        cells = ["–" if one.value is None else amount(one.value, one.unit) for one in estimates]
        yield f"| `{measure}` | {weight:.2f} | {' | '.join(cells)} |"
    values = {one.variant: one.value for one in decision.ranking}
    yield f"| **value** | | {' | '.join('–' if values[v] is None else f'{values[v]:.4f}' for v in shown)} |"


def _parameter(value: float | str, unit: str) -> str:
    return value if isinstance(value, str) else f"{value:g}{'' if unit in ('', '1') else f' {unit}'}"


def _deciding(decision: Decision, found: Robustness) -> Iterator[str]:
    gains = [
        (one.contribution - other.contribution, one.measure)
        for one, other in zip(decision.chosen_contributions, decision.runner_up_contributions, strict=False)
    ]
    ahead = ", ".join(f"`{measure}` ({gain:+.3f})" for gain, measure in sorted(gains, reverse=True) if gain > 5e-4)
    behind = ", ".join(f"`{measure}` ({gain:+.3f})" for gain, measure in sorted(gains) if gain < -5e-4)
    yield (
        f"*What decides it.* Against the runner-up it gains in {ahead or 'nothing'} and loses in {behind or 'nothing'}."
    )
    if decision.excluded_better:
        requirements = ", ".join(f"{one.requirement} ({one.excluded})" for one in decision.deciding_requirements)
        better = decision.counts.excluded_better
        yield f"{better} better {'variant misses' if better == 1 else 'variants miss'} a requirement: {requirements}."
    else:
        yield "No requirement excludes a better variant."
    weighting = found.weighting
    if weighting is None:
        return
    row = found.variants.index(decision.chosen or 0)
    indices = weighting.acceptability
    noise = " and the noise of the replicates" if weighting.with_noise else ""
    told = []
    if weighting.regions is not None:
        told.append(f"it is the best for {percent(weighting.regions[row].share)} of all weights")
    if indices is not None:
        told.append(
            f"over all weights{noise} it comes first in {percent(float(indices.first[row]))} of the draws, and at the "
            f"weights that are typical for it with a probability of {percent(float(indices.confidence[row]))}"
        )
    if told:
        text = "; ".join(told)
        yield f"{text[0].upper()}{text[1:]}."
    others = [shift for shift in weighting.shifts or () if shift.distance > 0.0]
    if others:
        nearest = min(others, key=lambda shift: (shift.sum_distance, shift.rows))
        before = dict(zip(found.measures, found.weights.tolist(), strict=True))
        after = dict(zip(found.measures, nearest.nearest_in_sum.tolist(), strict=True))
        winners = variants_text([found.variants[one] for one in nearest.rows])
        yield (
            f"Moving {nearest.sum_distance / 2.0:.3f} of weight ({moves_text(before, after)}) lets {winners} win; "
            "no smaller move changes the decision."
        )


def _costs(found: Robustness) -> Iterator[str]:
    box = found.costs
    if box is None:
        if "costs" in found.refused:
            yield f"*Whether the assumed costs matter* was not analysed: {found.refused['costs']}."
        return
    if box.range.factor is None:
        yield "*The assumed costs do not matter*: the choice stands wherever they are from 0 to twice what is assumed."
        return
    factor = percent(box.range.factor)
    winners = [found.variants[row] for row in box.range.overtaken_by]
    then = f"{variants_text(winners)} can win" if winners else "the choice can miss a requirement"
    yield (
        f"*The assumed costs matter.* All of them together may be off by ±{factor} before {then}. "
        "Alone, the choice stands while"
    )
    yield ""
    costs = {number.id for number in box.numbers}
    for one in found.assumptions:
        span = one.range
        if one.number.id not in costs or span is None or span.always:
            continue
        bounds = [
            f"at least {amount(span.low, 'USD')} (below, {ids_text(found.variants[row] for row in span.below)})"
            if span.low is not None
            else "",
            f"at most {amount(span.high, 'USD')}"
            + (f" (above, {ids_text(found.variants[row] for row in span.above)})" if span.above else "")
            if span.high is not None
            else "",
        ]
        told = " and ".join(bound for bound in bounds if bound)
        yield f"- `{one.number.component}` costs {told}; assumed are {amount(one.number.value, 'USD')}"
