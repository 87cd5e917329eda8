"""pygame, quietly, or a word on how to get it: the rest of this package imports it from here."""

import os

# It greets on standard output when it is imported, which would spoil piped output.
os.environ.setdefault("PYGAME_HIDE_SUPPORT_PROMPT", "1")
try:
    import pygame
    import pygame.font
except ModuleNotFoundError as error:
    message = "pictures need pygame-ce: pip install 'rsoccer[render]'"
    raise ModuleNotFoundError(message, name="pygame") from error

__all__ = ["pygame"]
