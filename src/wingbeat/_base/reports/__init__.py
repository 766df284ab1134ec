"""What results say about themselves: one list of blocks, printed by the command line and shown by notebooks."""

from wingbeat._base.reports.blocks import Block as Block
from wingbeat._base.reports.blocks import Line as Line
from wingbeat._base.reports.blocks import Notes as Notes
from wingbeat._base.reports.blocks import Report as Report
from wingbeat._base.reports.blocks import Row as Row
from wingbeat._base.reports.blocks import Table as Table
from wingbeat._base.reports.blocks import Tone as Tone
from wingbeat._base.reports.blocks import grouped as grouped
from wingbeat._base.reports.reported import Reported as Reported
from wingbeat._base.reports.reported import drawn as drawn

__all__ = ["Block", "Line", "Notes", "Report", "Reported", "Row", "Table", "Tone", "drawn", "grouped"]
