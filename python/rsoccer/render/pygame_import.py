"""The import of pygame: no greeting, and a clear error where pygame is missing."""

import os

# The greeting on standard output would spoil piped output.
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
try:
    import pygame
    import pygame.font
except ModuleNotFoundError as error:
    message = "pictures need pygame-ce: pip install 'rsoccer[render]'"
    raise ModuleNotFoundError(message, name="pygame") from error

__all__ = ["pygame"]
