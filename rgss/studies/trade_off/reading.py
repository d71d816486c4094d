"""Reading the trade-off of a study, with a finding for everything that is wrong in it."""

from __future__ import annotations

from rgss.studies.trade_off.document import TradeOffEntry
from rgss.studies.trade_off.places import SECTION, TradeOffPlaces
from rgss.studies.trade_off.programs import ProgramReader, read_portfolio, read_risks
from rgss.studies.trade_off.sections import TradeOff
from rgss.studies.trade_off.values import ValueReader
from rgss.tradeoff import weighting_of


def read_trade_off(entry: TradeOffEntry, places: TradeOffPlaces) -> TradeOff | None:
    """Read the section.

    Args:
        entry: The section as it stands in the file.
        places: Takes the findings.

    Returns:
        The trade-off; None if its weights are wrong. It can be used if nothing was found.
    """
    reader = ValueReader(places)
    nodes = reader.read(entry.values, entry.rank_rule, (*SECTION, "values"))
    orders = reader.orders(entry.weight_order, nodes)
    reader.check_bounds(nodes, orders)
    weights = {} if nodes is None else weighting_of(nodes).weights
    program = ProgramReader(places, reader.valued, weights).read(entry.decide_by)
    risks = read_risks(places, entry.chance, entry.tail)
    fleet = read_portfolio(places, entry.fleet)
    if entry.practical_margin < 0.0:
        message = f"the practical margin is {entry.practical_margin:g}"
        places.report("margin", message, (*SECTION, "practical_margin"), hint="give a value from 0 on, such as 0.01")
    if entry.practical_margin and program.name in ("lexicographic", "epsilon_constraint"):
        message = f"the {program.name} program compares quantities, not values"
        hint = "give its last measure a tolerance: what lies within it is listed as near"
        places.report("margin", message, (*SECTION, "practical_margin"), hint=hint)
    if fleet is not None and program.name != "additive":
        message = f"a fleet is chosen by weighted value, not by the {program.name} program"
        places.report("fleet", message, (*SECTION, "fleet"), hint="take the program out")
    if nodes is None:
        return None
    return TradeOff(
        valued=tuple(reader.valued),
        criteria=nodes,
        intervals=tuple(reader.intervals),
        orders=orders,
        program=program,
        risks=risks,
        practical_margin=entry.practical_margin,
        choose_levels=entry.choose == "levels",
        fleet=fleet,
    )
