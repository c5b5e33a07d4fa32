"""From run files (reports/run_file.md) to one page that opens offline, with its figures and tables beside
it.
"""
