"""What every package of wingbeat stands on: errors, files, names and units of quantities, and reports.

These four load nothing but the standard library. Data sets, sheets and the style of figures stand beside them.
"""

from wingbeat._base.errors import (
    IN_RADIANS,
    WHOLE,
    ClusterError,
    Fault,
    FaultList,
    FileError,
    ForkError,
    InvalidInputError,
    WingbeatError,
    WorkerError,
    control_in,
    first_line,
    install_extra,
    is_number,
    largest_angle,
    suggest,
    system_reason,
)
from wingbeat._base.files import MAX_LINE, make_folder, read_text, toml_tables, write_atomically, writing
from wingbeat._base.harmonics import FIRST_ORDER, HARMONIC_NAMES, HIGHEST_ORDER, SHARES, harmonic_place
from wingbeat._base.nomenclature import (
    NOMENCLATURE,
    PRECISION,
    Term,
    attributes_of,
    axis_label,
    cf,
    find,
    for_people,
    label_of,
    plain,
    plain_unit,
    readable_limit,
    written,
    written_range,
)
from wingbeat._base.nomenclature.answers import ANSWER, BEAT, STUDY
from wingbeat._base.nomenclature.given import AERO, GIVEN, RUN, WINGBEAT
from wingbeat._base.nomenclature.series import GLIDE, SERIES, SERIES_WHERE_ON
from wingbeat._base.reports import Block, Line, Notes, Report, Reported, Row, Table, Tone, drawn, grouped
from wingbeat._base.reports.html import html_of
from wingbeat._base.reports.text import WIDTH, Printed, lines_of, text_of
