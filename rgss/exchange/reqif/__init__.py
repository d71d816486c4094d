"""ReqIF 1.2 (OMG formal/16-07-01), both ways, by the library ``reqif``."""

from rgss.exchange.reqif.reading import read_reqif
from rgss.exchange.reqif.writing import reqif_text

__all__ = ["read_reqif", "reqif_text"]
