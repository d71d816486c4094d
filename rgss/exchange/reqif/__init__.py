"""ReqIF 1.2 (OMG formal/16-07-01), both ways, by the library ``reqif``; also as archives."""

from rgss.exchange.reqif.archive import ARCHIVE_ENDING, archive_of
from rgss.exchange.reqif.reading import read_reqif
from rgss.exchange.reqif.writing import reqif_text
