"""The playground: matches in a browser, as one page. `make playground` writes it."""
