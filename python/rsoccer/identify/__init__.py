"""Identification of robots, ball and delays from a short log of commands and poses.

`identify` fits the numbers with which the simulator drives as a log shows; `read_log` reads a log,
`program` commands what shows all numbers, and `record` makes a log of the simulator itself.
"""

from rsoccer.identify.identification import Identified, identify
from rsoccer.identify.log import Log
from rsoccer.identify.log_files import read_log, write_log
from rsoccer.identify.program import Program, program
from rsoccer.identify.recorder import record
from rsoccer.identify.report import report
from rsoccer.identify.results import Estimate

__all__ = [
    "Estimate",
    "Identified",
    "Log",
    "Program",
    "identify",
    "program",
    "read_log",
    "record",
    "report",
    "write_log",
]
