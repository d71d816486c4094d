"""Sequence diagrams: lifelines, messages below each other, and bounds on the time between them."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from rgss.reports.diagrams.canvas import Canvas
from rgss.reports.diagrams.drawing import Drawing
from rgss.reports.diagrams.frame import ORIGIN, Heading
from rgss.reports.diagrams.style import FONT, LINE, SMALL
from rgss.reports.diagrams.text import text_width, wrapped
from rgss.requirements import Behaviour
from rgss.requirements.behaviour import Interaction, Message, TimingConstraint

_MARGIN = 16.0
_HEAD_WIDTH, _HEAD_GAP = 150.0, 30.0
_LABEL_WIDTH = 230.0
_LOOP = 34.0
_ASIDE = 12.0
_AFTER = 14.0
_BOUND = 150.0


@dataclass(frozen=True, slots=True, kw_only=True)
class _Row:
    """Message with its position: the lines above its arrow, their centre, and the height of the arrow."""

    message: Message
    lines: tuple[str, ...]
    top: float
    y: float
    middle: float


def sequence_diagram(behaviour: Behaviour, names: Mapping[str, str], bounds: Mapping[str, str]) -> Drawing | None:
    """Sequence diagram of an interaction, from top to bottom; None while it is open.

    Args:
        behaviour: The sequence.
        names: The name of each block by its id.
        bounds: The success criterion of each requirement by its id, in words.
    """
    interaction = behaviour.interaction
    if interaction is None:
        return None
    heads = {name: wrapped(names.get(name, name), _HEAD_WIDTH, FONT, bold=True) for name in interaction.lifelines}
    ids = {name: wrapped(name, _HEAD_WIDTH, SMALL) for name in interaction.lifelines}
    xs, gaps, right = _columns(interaction)
    head_height = max((LINE * (FONT * len(heads[n]) + SMALL * len(ids[n])) for n in heads), default=0.0) + 12
    captions = max((LINE * SMALL * len(lines) for lines in _bound_texts(interaction, bounds)), default=0.0)
    start = _MARGIN + max(head_height, captions)
    rows = _rows(interaction, xs, gaps, start + 16)
    bottom = (rows[-1].y if rows else start) + 30
    canvas = Canvas(ORIGIN)
    for x in xs.values():
        canvas.line([(x, _MARGIN + head_height), (x, bottom)], "line dotted")
    for name, x in xs.items():
        with canvas.group(f"{names.get(name, name)} ({name})"):
            left = x - _HEAD_WIDTH / 2 - 6
            canvas.rectangle(left, _MARGIN, _HEAD_WIDTH + 12, head_height, "shape")
            y = canvas.lines(x, _MARGIN + 6, heads[name], FONT, "name", anchor="middle")
            canvas.lines(x, y, ids[name], SMALL, "soft", anchor="middle")
    for row in rows:
        _draw_message(canvas, row, xs)
    right = _draw_bounds(canvas, interaction, rows, bounds, right)
    return Drawing(
        name=f"sequence-{behaviour.id}",
        title=f"Sequence diagram: {behaviour.name}",
        description=f"{behaviour.id}: {behaviour.text}",
        text_alternative=_describe(interaction, names, bounds),
        heading=Heading(kind="sd", element="Interaction", subject=behaviour.name),
        inner=(right + _MARGIN, bottom + _MARGIN),
        canvas=canvas,
    )


def _columns(interaction: Interaction) -> tuple[dict[str, float], dict[str, float], float]:
    """Positions of the lifelines, the room beside each, and the right edge of all.

    A label is between the lifeline of its source and the next one towards its target, where no line
    passes, so that this gap is as wide as the label.
    """
    order = {name: index for index, name in enumerate(interaction.lifelines)}
    gaps = [_HEAD_WIDTH + 12 + _HEAD_GAP] * len(order)
    for message in interaction.messages:
        width = min(_label_width(message), _LABEL_WIDTH) + 2 * _ASIDE
        beside = _gap_of(message, order)
        gaps[beside] = max(gaps[beside], width + _LOOP if message.source == message.target else width)
    xs: dict[str, float] = {}
    x = _MARGIN + _HEAD_WIDTH / 2 + 6
    for name, gap in zip(interaction.lifelines, gaps, strict=True):
        xs[name] = x
        x += gap
    last_gap = gaps[-1] if gaps else 0.0
    talks_to_itself = any(_gap_of(message, order) == len(order) - 1 for message in interaction.messages)
    right = x - last_gap + max(_HEAD_WIDTH / 2 + 6, last_gap - _ASIDE if talks_to_itself else 0.0)
    return xs, dict(zip(interaction.lifelines, gaps, strict=True)), right


def _gap_of(message: Message, order: Mapping[str, int]) -> int:
    """Index of the lifeline to the left of a message's label."""
    leftwards = order[message.target] < order[message.source]
    return order[message.source] - 1 if leftwards else order[message.source]


def _rows(interaction: Interaction, xs: Mapping[str, float], gaps: Mapping[str, float], top: float) -> list[_Row]:
    order = {name: index for index, name in enumerate(interaction.lifelines)}
    rows = []
    for message in interaction.messages:
        own = message.source == message.target
        left = interaction.lifelines[_gap_of(message, order)]
        room = gaps[left] - 2 * _ASIDE - (_LOOP if own else 0)
        lines = tuple(line for text in _texts(message) for line in wrapped(text, room, SMALL))
        y = top + LINE * SMALL * len(lines) + 3
        middle = xs[left] + gaps[left] / 2
        rows.append(_Row(message=message, lines=lines, top=top, y=y, middle=middle))
        top = y + _AFTER + (14 if own else 0)
    return rows


def _draw_message(canvas: Canvas, row: _Row, xs: Mapping[str, float]) -> None:
    message = row.message
    start, end = xs[message.source], xs[message.target]
    style, head = ("line dashed", "open") if message.reply else ("line", "filled")
    with canvas.group(f"{message.source} → {message.target}: {' '.join(_texts(message))}"):
        if start == end:
            canvas.lines(start + _ASIDE, row.top, row.lines, SMALL, "label", anchor="start")
            canvas.line(
                [(start, row.y), (start + _LOOP, row.y), (start + _LOOP, row.y + 14), (start, row.y + 14)], style
            )
            canvas.arrow((start, row.y + 14), (start + _LOOP, row.y + 14), head)
        else:
            canvas.lines(row.middle, row.top, row.lines, SMALL, "label", anchor="middle")
            canvas.line([(start, row.y), (end, row.y)], style)
            canvas.arrow((end, row.y), (start, row.y), head)


def _bound_texts(interaction: Interaction, bounds: Mapping[str, str]) -> list[tuple[str, ...]]:
    return [
        tuple(line for text in _bound(timing, bounds) for line in wrapped(text, _BOUND, SMALL))
        for timing in interaction.timings
    ]


def _draw_bounds(
    canvas: Canvas, interaction: Interaction, rows: list[_Row], bounds: Mapping[str, str], right: float
) -> float:
    """Draw each bound in its own column, with its text at the top; returns the new right edge."""
    places = {row.message.id: row.y for row in rows}
    for timing, lines in zip(interaction.timings, _bound_texts(interaction, bounds), strict=True):
        x = right + 18
        right = x + max(text_width(line, SMALL) for line in lines)
        first, last = sorted((places[timing.first], places[timing.last]))
        with canvas.group(" ".join(_bound(timing, bounds))):
            foot = canvas.lines(x, _MARGIN, lines, SMALL, "", anchor="start")
            x += 8
            for y in (first, last):
                canvas.line([(_MARGIN, y), (x - 8, y)], "line dotted thin")
                canvas.line([(x - 8, y), (x + 8, y)], "line thin")
            canvas.line([(x, foot + 4), (x, first)], "line dotted thin")
            canvas.line([(x, first), (x, last)], "line")
            canvas.arrow((x, first), (x, last), "open")
            canvas.arrow((x, last), (x, first), "open")
    return right


def _texts(message: Message) -> tuple[str, ...]:
    return (message.text, f"calls {message.does}") if message.does else (message.text,)


def _bound(timing: TimingConstraint, bounds: Mapping[str, str]) -> tuple[str, ...]:
    return (f"{{{bounds.get(timing.criterion_of, '')}}}", timing.text, timing.criterion_of)


def _label_width(message: Message) -> float:
    return max(text_width(text, SMALL) for text in _texts(message))


def _describe(interaction: Interaction, names: Mapping[str, str], bounds: Mapping[str, str]) -> str:
    parts = []
    for one in interaction.messages:
        source, target = names.get(one.source, one.source), names.get(one.target, one.target)
        parts.append(f"{source} {'answers' if one.reply else 'to'} {target}: {one.text}.")
    parts += [f"From {one.first} to {one.last}: {' '.join(_bound(one, bounds))}." for one in interaction.timings]
    return " ".join(parts)
