"""What results say about themselves: one list of blocks, printed by the command line and shown by notebooks."""

from wingbeat.reports.blocks import Block as Block
from wingbeat.reports.blocks import Line as Line
from wingbeat.reports.blocks import Notes as Notes
from wingbeat.reports.blocks import Report as Report
from wingbeat.reports.blocks import Row as Row
from wingbeat.reports.blocks import Table as Table
from wingbeat.reports.blocks import Tone as Tone
from wingbeat.reports.blocks import grouped as grouped
from wingbeat.reports.reported import Reported as Reported
from wingbeat.reports.reported import drawn as drawn

__all__ = ["Block", "Line", "Notes", "Report", "Reported", "Row", "Table", "Tone", "drawn", "grouped"]
