"""Reader of ranges of factors and of samples."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from rgss.designs.document import DesignSpaceModel, FactorModel
from rgss.designs.factors import Factor, Span, exact
from rgss.designs.findings import near_hint
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
    findings: list[Finding] = []

    def report(rule: str, message: str, *key: str | int, hint: str, at_key: bool = False) -> None:
        findings.append(document.finding(f"design.{rule}", message, (*place, *key), hint=hint, at_key=at_key))

    name = model.parameter or ""
    parameter = parameters.get(name)
    if parameter is None:
        hint = near_hint(name, parameters, "known parameters")
        report("unknown-parameter", f"unknown design parameter {name!r}", "parameter", hint=hint)
        return None, findings
    if parameter.kind is ParameterKind.NAME:
        report("range", f"{name} has names, which have no range", "parameter", hint="write levels")
        return None, findings
    counted = parameter.kind is ParameterKind.COUNT
    written = model.range or ()
    if len(written) != 2:
        report("range", f"the range of {name} has {len(written)} ends", "range", hint="write [least, greatest]")
        return None, findings
    numbers: list[float | int] = []
    resolution = model.resolution if model.resolution is not None or not counted else 1
    if resolution is None:
        hint = "add the 'resolution' to which values are rounded, such as a hundredth of the range"
        report("range", f"the range of {name} has no resolution", "range", hint=hint, at_key=True)
        return None, findings
    for value, key in ((written[0], ("range", 0)), (written[1], ("range", 1)), (resolution, ("resolution",))):
        try:
            number = parameter.read(value)
        except QuantityError as error:
            report("value", f"{name}: {error.message}", *key, hint=error.hint)
            continue
        if not isinstance(number, str):
            numbers.append(number)
    if findings:
        return None, findings
    low, high, step = numbers
    if low >= high:
        report("range", f"the range of {name} is empty", "range", hint="write [least, greatest]")
    elif step <= 0:
        report("range", f"the resolution of {name} must be greater than zero", "resolution", hint="write a step")
    else:
        steps = (exact(high) - exact(low)) / exact(step)
        whole = max(1, round(steps))
        if abs(steps - whole) <= _TOLERANCE * whole:
            return Span(parameter=name, unit=parameter.unit, low=low, high=high, steps=whole, counted=counted), []
        ends = f"{format_value(low, parameter.unit)} to {format_value(high, parameter.unit)}"
        message = f"{ends} is not a whole number of steps of {format_value(step, parameter.unit)}"
        where = "range" if model.resolution is None else "resolution"
        report("range", message, where, hint="make the range a multiple of the resolution")
    return None, findings


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
