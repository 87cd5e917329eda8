"""The playground: matches in a browser, as one page without a network. `make playground` writes it."""
