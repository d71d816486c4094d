"""Reader of pairwise answers on swings."""

from __future__ import annotations

import math
from collections.abc import Sequence

from rgss.errors import TradeoffError
from rgss.studies.trade_off.document import AnswerEntry
from rgss.studies.trade_off.places import Place, TradeOffPlaces
from rgss.tradeoff.elicitation import ElicitedWeights, PairwiseAnswer, contradiction_of


class AnswerReader:
    """Reader of a list of answers, which gives the weights of one group of criteria after the other."""

    def __init__(self, places: TradeOffPlaces, entries: Sequence[AnswerEntry], at: Place) -> None:
        self.elicited: list[ElicitedWeights] = []
        self._places = places
        self._at = at
        self._answers = [(index, self._answer(entry, (*at, index))) for index, entry in enumerate(entries)]
        self._used: set[int] = set()

    def __bool__(self) -> bool:
        return bool(self._answers)

    def weights(self, names: Sequence[str]) -> ElicitedWeights | None:
        """The weights of the members of a group; findings and None if the answers give none."""
        # Needs NumPy, which reading a study with stated weights does not load.
        from rgss.tradeoff.elicitation import weights_from_answers

        mine = [
            (index, answer)
            for index, answer in self._answers
            if answer is not None and answer.swing_of in names and answer.over in names
        ]
        self._used.update(index for index, _ in mine)
        if any(answer is None for _, answer in self._answers):
            return None
        answers = [answer for _, answer in mine]
        contradiction = contradiction_of(names, [answer for answer in answers if not answer.is_ratio])
        bounds = [index for index, answer in mine if not answer.is_ratio]
        first = 0 if contradiction is None else bounds[contradiction.places[0]]
        at = self._at if contradiction is None else (*self._at, first)
        try:
            found = weights_from_answers(names, answers)
        except TradeoffError as error:
            self._places.report("elicitation", error.message, at, hint=error.hint)
            return None
        self.elicited.append(found)
        return found

    def check_used(self, known: Sequence[str]) -> None:
        """Report answers that weigh no group."""
        for index, answer in self._answers:
            if answer is None or index in self._used:
                continue
            unknown = [(key, name) for key, name in _named(answer) if name not in known]
            for key, name in unknown:
                message = f"no criterion {name!r} is valued"
                self._places.report(
                    "elicitation", message, (*self._at, index, key), hint=f"criteria: {', '.join(known)}"
                )
            if not unknown:
                message = f"{answer.swing_of!r} and {answer.over!r} are not members of one group without weights"
                hint = "compare members of one group, and give that group no weight, points or rank"
                self._places.report("elicitation", message, (*self._at, index), hint=hint)

    def _answer(self, entry: AnswerEntry, at: Place) -> PairwiseAnswer | None:
        if entry.ratio is not None and entry.between is not None:
            message = "an answer is a ratio or a range of ratios"
            self._places.report("elicitation", message, (*at, "between"), hint="keep 'ratio' or 'between'")
            return None
        key, least, most = "swing_of", 1.0, math.inf
        if entry.ratio is not None:
            key, least, most = "ratio", entry.ratio, entry.ratio
        elif entry.between is not None:
            key, (least, most) = "between", entry.between
            if least == most:
                message = f"a range of ratios needs two different numbers, got {least:g} twice"
                self._places.report(
                    "elicitation", message, (*at, key), hint=f"write 'ratio: {least:g}' for a judgement"
                )
                return None
        try:
            return PairwiseAnswer(swing_of=entry.swing_of, over=entry.over, least=least, most=most)
        except TradeoffError as error:
            self._places.report("elicitation", error.message, (*at, key), hint=error.hint)
            return None


def _named(answer: PairwiseAnswer) -> tuple[tuple[str, str], tuple[str, str]]:
    return ("swing_of", answer.swing_of), ("over", answer.over)
