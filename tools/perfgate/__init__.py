"""perfgate: compares two builds of a Google Benchmark program and says whether one is slower.

Start it as `python3 tools/perfgate COMMAND`. GUIDE.md beside this file is the way in; the layers are

    cli            the command line
    run, history   what starts processes, reads and writes files
    output         text, JSON, JUnit, Markdown, HTML from a report
    model          configuration, measurements, the report and its verdicts: no clock, no processes
    stats          exact statistics on plain lists of numbers: knows nothing of the above
    simulate       noise models, and what the statistics make of them

Python 3.9 or later, nothing but the standard library.
"""

__version__ = "1.0"
SCHEMA = 1  # of report.json, calibration.json and history lines
