"""`python -m rsoccer` is the command `rsoccer`."""

import sys

from rsoccer.cli import main

if __name__ == "__main__":
    sys.exit(main())
