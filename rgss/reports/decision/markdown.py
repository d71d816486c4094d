"""The decision as a section in Markdown, and its place between two markers of a file."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from pathlib import Path

from rgss.counted import counted
from rgss.decision.robustness import not_computed_lines
from rgss.decision.sensitivity import ExchangeRates
from rgss.decision.study_decision import RobustnessFindings, SideBySide, StudyDecision
from rgss.documents import LARGEST_FILE_BYTES, chunks_of
from rgss.errors import DefinitionError
from rgss.invisible_characters import visible
from rgss.reports.decision.assumption_rows import ASSUMPTION_HEADS, assumption_rows, assumption_sentences
from rgss.reports.decision.conclusion import (
    headline,
    rule_sentence,
    seeds_sentences,
    stale_sentence,
    standing_sentence,
    uncertainty_sentences,
)
from rgss.reports.decision.conflict_tables import conflict_tables, unmeasured_headline
from rgss.reports.decision.exchange_sentences import worth_sentences
from rgss.reports.decision.sensitivity_sentences import tied_by_weights_sentence
from rgss.reports.decision.sentences import nearest_sentence
from rgss.reports.decision.words import (
    UNKNOWN,
    amount,
    basis_text,
    ids_text,
    kept_amount,
    kept_share,
    moves_text,
    score,
    share_text,
    variants_text,
)
from rgss.trace.views import share_in_words, value_in_words

BEGIN = "<!-- decision: written by `rgss trade --section --into FILE`; do not edit -->"
END = "<!-- end of decision -->"


def decision_section(made: StudyDecision) -> str:
    """The decision, the reasons for it, and the effect of the assumed costs, between its markers."""
    parts = [BEGIN, ""]
    found, exchange = made.robustness, None if made.sensitivity is None else made.sensitivity.exchange
    if made.comparison is None:
        parts += [*_conflicts(made), ""]
    elif found is not None:
        parts += [*_choice(made, made.comparison), ""]
        parts += [*_deciding(made, made.comparison, found), ""]
        if exchange is not None:
            parts += [*_exchange(exchange), ""]
        parts += [*_costs(found), ""]
    if made.assumptions:
        parts += [*_assumptions(made), ""]
    for line in () if found is None else not_computed_lines(found.analysis.not_computed):
        parts += [line, ""]
    return visible("\n".join([*parts, END]))


def _assumptions(made: StudyDecision) -> Iterator[str]:
    """The table of the modelling assumptions, and its summary."""
    yield from _table(ASSUMPTION_HEADS, [(f"`{row.cells[0]}`", *row.cells[1:]) for row in assumption_rows(made)])
    yield ""
    yield " ".join(assumption_sentences(made))


def _table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> Iterator[str]:
    yield f"| {' | '.join(heads)} |"
    yield "|" + "---|" * len(heads)
    for row in rows:
        yield f"| {' | '.join(_escaped(cell) for cell in row)} |"


def _escaped(cell: str) -> str:
    return cell.replace("|", "\\|")


def text_with_place(file: Path) -> str:
    """Text of a file that has the markers of the section.

    Raises:
        DefinitionError: The file cannot be read, or does not have each marker exactly once.
    """
    try:
        # Read as bytes, so that its line ends are kept.
        text = b"".join(chunks_of(file, largest=LARGEST_FILE_BYTES)).decode("utf-8")
    except (OSError, ValueError) as error:
        raise DefinitionError(f"{str(file)!r} cannot be read", hint="name a Markdown file") from error
    if text.count(BEGIN) != 1 or text.count(END) != 1 or text.index(BEGIN) > text.index(END):
        raise DefinitionError(
            f"{str(file)!r} has no place for the decision", hint=f"write {BEGIN!r} and, below it, {END!r}"
        )
    return text


def with_section(text: str, section: str) -> str:
    """A text with another section between its markers."""
    ended = section.replace("\n", "\r\n") if "\r\n" in text else section
    return text.partition(BEGIN)[0] + ended + text.partition(END)[2]


def _conflicts(made: StudyDecision) -> Iterator[str]:
    """What no variant meets, and what would be enough."""
    yield from filter(None, (headline(made), stale_sentence(made), unmeasured_headline(made.decision)))
    found = made.decision.conflicts
    for table in () if found is None else conflict_tables(made.decision, found):
        yield ""
        yield from _table(table.heads, table.rows)
        for note in table.notes:
            yield from ("", note)
    if found is not None:
        yield from ("", nearest_sentence(made.decision, found))


def _choice(made: StudyDecision, compared: SideBySide) -> Iterator[str]:
    decision = made.decision
    others = decision.ties[1:]
    ties = f" ({variants_text(others)} {'is' if len(others) == 1 else 'are'} as good)" if others else ""
    within = (
        f", within the tolerance of {share_text(made.tolerance)} on what varies from trial to trial"
        if made.tolerance
        else ""
    )
    basis = basis_text(shown_feasible=made.shown_feasible)
    trials = counted(made.trials, "trial")
    if made.is_alone:
        yield (
            f"**Variant {decision.chosen}**, the only one compared, is chosen with {trials}; it meets every "
            f"requirement by its {basis}{within}."
        )
    else:
        feasible = decision.counts.feasible
        meet = "meets every requirement by its" if feasible == 1 else "meet every requirement by their"
        yield (
            f"**Variant {decision.chosen}** is chosen{ties} from {made.variants} variants with {trials}; "
            f"{feasible} of them {meet} {basis}{within}."
        )
    yield ""
    standing = (headline(made), standing_sentence(made), stale_sentence(made), rule_sentence(made))
    lines = (*standing, *uncertainty_sentences(made), *seeds_sentences(made.seeds))
    yield from (f"- {line}" for line in lines if line)
    yield ""
    shown = len(compared.variants)
    yield f"| | weight | {' | '.join(['chosen', 'runner-up'][:shown])} |"
    yield "|---|---|" + "---|" * shown
    yield f"| variant | | {' | '.join(map(str, compared.variants))} |"
    for parameter in compared.parameters:
        cells = [_parameter(value, parameter.unit) for value in parameter.cells]
        yield f"| {parameter.name} | | {' | '.join(cells)} |"
    for row in compared.measures:
        cells = [UNKNOWN if value is None else amount(value, row.unit) for value in row.cells]
        yield f"| `{row.measure}` | {row.weight:.2f} | {' | '.join(cells)} |"
    yield f"| **value** | | {' | '.join(map(score, compared.values))} |"
    for one in compared.objectives:
        yield f"| **{one.place}. {one.name}** | | {' | '.join(map(value_in_words, one.cells))} |"


def _parameter(value: float | str, unit: str) -> str:
    return value if isinstance(value, str) else value_in_words(value, unit or "1")


def _lead(made: StudyDecision, compared: SideBySide) -> str:
    """Sentence on the lead over the runner-up, in what the program decides by."""
    if compared.objectives:
        rows = [(row.name, [value_in_words(cell) for cell in row.cells]) for row in compared.objectives]
        parts = [f"`{name}` {cells[0]}" + "".join(f" (runner-up {each})" for each in cells[1:]) for name, cells in rows]
        return f"The objectives of the program, in turn: {', '.join(parts)}."
    if len(compared.variants) == 1:
        return "No other variant meets every requirement, so that there is no runner-up."
    gains = sorted((gain.amount, gain.measure) for gain in made.gains)
    ahead = ", ".join(f"`{measure}` ({gain:+.3f})" for gain, measure in reversed(gains) if gain > 5e-4)
    behind = ", ".join(f"`{measure}` ({gain:+.3f})" for gain, measure in gains if gain < -5e-4)
    return f"Against the runner-up it gains in {ahead or 'nothing'} and loses in {behind or 'nothing'}."


def _deciding(made: StudyDecision, compared: SideBySide, found: RobustnessFindings) -> Iterator[str]:
    decision = made.decision
    if made.is_alone:
        yield "*What decides it.* No other variant is compared, so that no weight changes the choice."
        return
    yield f"*What decides it.* {_lead(made, compared)}"
    if decision.excluded_better:
        requirements = ", ".join(f"{one.requirement} ({one.excluded})" for one in decision.deciding_requirements)
        better = decision.counts.excluded_better
        yield f"{better} better {'variant is' if better == 1 else 'variants are'} infeasible: {requirements}."
    else:
        yield "No requirement excludes a better variant."
    shares = "; ".join(_shares(made, found))
    if shares:
        yield f"{shares[0].upper()}{shares[1:]}."
    move, tied = found.nearest_move, found.tied_by_weights
    if tied:
        yield tied_by_weights_sentence(tied)
    elif move is not None:
        yield (
            f"Moving {move.moved:.3f} of weight ({moves_text(move.before, move.after)}) lets "
            f"{variants_text(move.winners)} win; no smaller move of these weights changes the decision."
        )


def _shares(made: StudyDecision, found: RobustnessFindings) -> Iterator[str]:
    """The shares of weights and of draws at which the choice is the best."""
    weighting = found.analysis.weighting
    if weighting is None:
        return
    row = found.analysis.variants.index(made.decision.chosen or 0)
    if weighting.regions is not None:
        yield f"it is the best for {share_in_words(weighting.regions[row].share)} of all weights"
    indices = weighting.acceptability
    if indices is not None:
        first, confidence = share_in_words(float(indices.first[row])), share_in_words(float(indices.confidence[row]))
        if not weighting.with_noise:
            yield f"over all weights it comes first in {first} of the draws"
            return
        yield (
            f"over all weights and the noise of the replicates it comes first in {first} of the draws, and at the "
            f"weights that are typical for it with a probability of {confidence}"
        )


def _exchange(found: ExchangeRates) -> Iterator[str]:
    worth = worth_sentences(found, code="`")
    if worth:
        yield f"*What differences are worth to it, in `{found.reference}`.* {worth}"


def _costs(found: RobustnessFindings) -> Iterator[str]:
    box, refused = found.analysis.costs, found.analysis.refused
    if box is None:
        if "costs" in refused:
            yield f"*Whether the assumed costs of components matter* was not analysed: {refused['costs']}."
        return
    if box.range.factor is None:
        yield (
            "*The assumed costs of components do not matter*: the choice stands wherever they are from 0 to twice "
            "what is assumed."
        )
        return
    winners = found.variants(box.range.overtaken_by)
    then = f"{variants_text(winners)} can win" if winners else "the choice can be infeasible"
    yield (
        "*The assumed costs of components matter.* All of them together may be off by "
        f"±{kept_share(box.range.factor, 1)} before {then}. Alone, the choice stands while"
    )
    yield ""
    costs = {number.id for number in box.numbers}
    for one in found.decisive:
        span = one.range
        if one.number.id not in costs or span is None:
            continue
        bounds = []
        if span.low is not None:
            least = kept_amount(span.low, one.number.unit, is_least=True)
            bounds.append(f"at least {least} (below, {ids_text(found.variants(span.below))})")
        if span.high is not None:
            above = f" (above, {ids_text(found.variants(span.above))})" if span.above else ""
            bounds.append(f"at most {kept_amount(span.high, one.number.unit, is_least=False)}{above}")
        assumed = amount(one.number.value, one.number.unit)
        yield f"- `{one.number.component}` costs {' and '.join(bounds)}; assumed are {assumed}"
