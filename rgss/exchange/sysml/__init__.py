"""SysML v2: the model in the textual notation of the language (OMG formal/25-09, part 1)."""

from rgss.exchange.sysml.model import sysml_text
