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
    InvalidInputError,
    WingbeatError,
    WorkerError,
    control_in,
    first_line,
    install_extra,
    is_number,
    suggest,
    system_reason,
)
from wingbeat._base.files import make_folder, read_text, toml_tables, write_atomically, writing
from wingbeat._base.nomenclature import (
    FIRST_ORDER,
    GLIDE,
    HARMONIC_NAMES,
    HIGHEST_ORDER,
    KIND,
    NOMENCLATURE,
    PRECISION,
    RTOL,
    RUN,
    SERIES,
    SERIES_WHERE_ON,
    SHAPE,
    SHARES,
    STATE_NAMES,
    Term,
    attributes_of,
    axis_label,
    cf,
    climb_text,
    find,
    for_people,
    harmonic_place,
    heading,
    in_words,
    label_of,
    plain,
    plain_unit,
    readable_limit,
    written,
    written_range,
)
from wingbeat._base.reports import (
    Block,
    Line,
    Notes,
    Report,
    Reported,
    Row,
    Table,
    Tone,
    grouped,
    lines_of,
    text_of,
)
from wingbeat._version import NUMERICAL_VERSION, __version__
