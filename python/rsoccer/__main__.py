"""Entry point of `python -m rsoccer`, the same as the command `rsoccer`."""

import sys

from rsoccer.cli import main

if __name__ == "__main__":
    sys.exit(main())
