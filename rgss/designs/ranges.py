"""Reader of ranges of factors and of samples."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rgss.designs.document import DesignSpaceModel, FactorModel
from rgss.designs.factors import Factor, Span, exact
from rgss.designs.findings import DesignFileReader, near_hint
from rgss.designs.parameters import DesignParameter, ParameterKind, format_value
from rgss.designs.sampling import Sample, SamplingMethod, sample_factors
from rgss.documents import Document
from rgss.errors import QuantityError
from rgss.findings import Finding

_TOLERANCE = 1e-9
"""Relative tolerance of a whole number of steps, since unit conversions are not exact."""


def read_span(
    document: Document, place: Sequence[str | int], model: FactorModel, parameters: Mapping[str, DesignParameter]
) -> tuple[Span | None, list[Finding]]:
    """Read the range of a factor.

    Args:
        document: The file.
        place: Location of the factor.
        model: The entry of the file; it has a parameter and a range.
        parameters: The design parameters by id.

    Returns:
        The range, or None with findings.
    """
    return _SpanReader(document, place, model, parameters).read()


class _SpanReader(DesignFileReader):
    """Reader of the range of one factor."""

    def __init__(
        self,
        document: Document,
        place: Sequence[str | int],
        model: FactorModel,
        parameters: Mapping[str, DesignParameter],
    ) -> None:
        super().__init__(document)
        self._place = place
        self._model = model
        self._parameters = parameters

    def read(self) -> tuple[Span | None, list[Finding]]:
        """The range, or None with findings."""
        parameter = self._parameter()
        span = None if parameter is None else self._span(parameter)
        return span, self._findings

    def _parameter(self) -> DesignParameter | None:
        """The parameter, if it is one that may have a range."""
        name = self._model.parameter or ""
        parameter = self._parameters.get(name)
        if parameter is None:
            hint = near_hint(name, self._parameters, "known parameters")
            self._at("unknown-parameter", f"unknown design parameter {name!r}", "parameter", hint=hint)
        elif parameter.kind is ParameterKind.NAME:
            self._at("range", f"{name} has names, which have no range", "parameter", hint="write levels")
            return None
        return parameter

    def _span(self, parameter: DesignParameter) -> Span | None:
        name, unit = parameter.id, parameter.unit
        numbers = self._numbers(parameter)
        if numbers is None:
            return None
        low, high, step = numbers
        if low >= high:
            self._at("range", f"the range of {name} is empty", "range", hint="write [least, greatest]")
            return None
        if step <= 0:
            message = f"the resolution of {name} must be greater than zero"
            self._at("range", message, "resolution", hint="write a step")
            return None
        steps = (exact(high) - exact(low)) / exact(step)
        whole = max(1, round(steps))
        if abs(steps - whole) <= _TOLERANCE * whole:
            counted = parameter.kind is ParameterKind.COUNT
            return Span(parameter=name, unit=unit, low=low, high=high, steps=whole, counted=counted)
        ends = f"{format_value(low, unit)} to {format_value(high, unit)}"
        message = f"{ends} is not a whole number of steps of {format_value(step, unit)}"
        where = "range" if self._model.resolution is None else "resolution"
        self._at("range", message, where, hint="make the range a multiple of the resolution")
        return None

    def _numbers(self, parameter: DesignParameter) -> list[float | int] | None:
        """Both ends and the resolution; None if one is missing or no value of the parameter."""
        name, written, resolution = parameter.id, self._model.range or (), self._model.resolution
        if len(written) != 2:
            message = f"the range of {name} has {len(written)} ends"
            self._at("range", message, "range", hint="write [least, greatest]")
            return None
        if resolution is None and parameter.kind is ParameterKind.COUNT:
            resolution = 1
        if resolution is None:
            hint = "add the 'resolution' to which values are rounded, such as a hundredth of the range"
            self._at("range", f"the range of {name} has no resolution", "range", hint=hint, at_key=True)
            return None
        numbers: list[float | int] = []
        for value, key in ((written[0], ("range", 0)), (written[1], ("range", 1)), (resolution, ("resolution",))):
            try:
                number = parameter.read(value)
            except QuantityError as error:
                self._at("value", f"{name}: {error.message}", *key, hint=error.hint)
                continue
            if not isinstance(number, str):
                numbers.append(number)
        return None if self._findings else numbers

    def _at(self, rule: str, message: str, *key: str | int, hint: str, at_key: bool = False) -> None:
        self._report(rule, message, *self._place, *key, hint=hint, at_key=at_key)


def sample_findings(document: Document, model: DesignSpaceModel) -> Iterator[Finding]:
    """Findings on the sample of a space."""
    if model.sample is None:
        for index, factor in enumerate(model.factors):
            if factor.range is not None:
                message = f"factor {factor.id!r} has a range, so the file needs 'sample'"
                hint = "add 'sample: {method: sobol, size: 64, seed: 1}' to the file, or write levels"
                yield document.finding("design.sample", message, ("factors", index, "range"), hint=hint, at_key=True)
        return
    if not model.factors:
        message = "the sample has no factor"
        hint = "add a factor, or remove 'sample'"
        yield document.finding("design.sample", message, ("sample",), hint=hint, at_key=True)
    size = model.sample.size
    if model.sample.method is SamplingMethod.SOBOL and size & (size - 1):
        below = 1 << (size.bit_length() - 1)
        message = f"the size of a Sobol sample must be a power of two, got {size}"
        near = f"{below}" if below * 2 > 65_536 else f"{below} or {below * 2}"
        hint = f"write {near}, or use latin_hypercube"
        yield document.finding("design.sample", message, ("sample", "size"), hint=hint)


def read_sample(model: DesignSpaceModel, factors: Sequence[Factor]) -> Sample | None:
    """Sample points of a space with valid factors and sample."""
    if model.sample is None:
        return None
    return sample_factors(factors, method=model.sample.method, size=model.sample.size, seed=model.sample.seed)
