"""Import and export of requirements as tables: CSV and Excel."""

from rgss.exchange.tables.csv_file import csv_text, read_csv
from rgss.exchange.tables.excel_file import excel_bytes, read_excel
from rgss.exchange.tables.foreign_rows import ForeignTable
