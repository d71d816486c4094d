"""Renderers of a study's decision: text, Markdown, JSON, and its parts of the HTML report."""

from typing import TYPE_CHECKING

from rgss.lazy_exports import lazy_exports

if TYPE_CHECKING:
    from rgss.reports.decision.answers_in_words import elicitation_sentences
    from rgss.reports.decision.conclusion import (
        headline,
        rule_sentence,
        seeds_sentences,
        stale_sentence,
        standing_sentence,
    )
    from rgss.reports.decision.json import decision_to_json, elicitation_to_json, screening_to_json, trade_document
    from rgss.reports.decision.markdown import decision_section, text_with_place, with_section
    from rgss.reports.decision.model_sentences import model_cautions, substitution_sentence
    from rgss.reports.decision.report_conflicts import conflict_part
    from rgss.reports.decision.report_part import decision_part
    from rgss.reports.decision.report_sensitivity import sensitivity_part
    from rgss.reports.decision.sensitivity_sentences import no_rival_clause
    from rgss.reports.decision.sentences import cautions, certificate_sentence, gap_sentence, reasons
    from rgss.reports.decision.text import (
        decision_lines,
        question_lines,
        screening_lines,
        usable_resamples_sentence,
        weighing_lines,
    )
    from rgss.reports.decision.tornado_picture import tornado_svgs
    from rgss.reports.decision.until_decided import open_paragraph, until_decided_summary
    from rgss.reports.decision.words import ids_text, quantity_text, variants_text
else:
    __getattr__, __dir__ = lazy_exports(__name__, __file__)
