"""Reporting a study: tables, pictures and pages, from the files of its results alone."""
