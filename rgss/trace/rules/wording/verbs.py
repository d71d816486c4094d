"""Verbs that requirements use, to tell 'open and close' from 'position and velocity'."""

from __future__ import annotations

from rgss.trace.sentences import words_of

VERBS = frozenset(
    words_of("""
    accelerate accept achieve activate adapt adjust advance align allow analyse announce apply approach assign
    avoid begin bring calculate calibrate carry choose clear close collect command communicate compare compensate
    complete compute confirm connect continue convert correct create deactivate decelerate decide deliver detect
    determine disable disconnect display distinguish eject enable end enforce ensure enter establish evaluate execute
    expand explain extend fail find follow generate give grip guide handle identify ignore illuminate include
    indicate inform inhibit initialise initialize inspect install issue keep launch leave let lift lower maintain
    make measure meet notify obtain open operate perform permit pick predict prepare present preserve prevent
    proceed protect provide pull push raise reach read receive recognise recognize recover refuse reject release
    remain remove render repeat replace reproduce resist respond restart restore resume retract retrieve return
    rotate satisfy save select send separate serve settle shut simulate slide stay store supply suspend switch
    synchronise synchronize take tell terminate throw transfer transmit turn unload update validate verify wait warn
    withdraw withstand write
    """)
)
"""Those that are hardly ever nouns behind 'and'."""

AMBIGUOUS_VERBS = frozenset(
    words_of("""
    alarm alert archive balance block brake bound buffer call change charge check clamp clean contact control copy
    count cover cut delay delete display document drive drop fill filter fix force grasp group halt heat hold label
    limit link list load lock log mark match monitor mount move name order park pass pause place plan plot power
    press print process queue record reduce refresh register report request require reset retry reverse route run
    sample scale scan schedule seal search secure sense set share shift show signal sort start state step stop
    store support test time trace track trade transport trigger use view vent
    """)
)
"""Those that are nouns as well; a verb only where an article or a preposition follows."""
