"""Import and export of ReqIF 1.2 (OMG formal/16-07-01) and its archives, by the library ``reqif``."""

from rgss.exchange.reqif.archive import ARCHIVE_ENDING, archive_of
from rgss.exchange.reqif.reading import read_reqif
from rgss.exchange.reqif.writing import reqif_text
