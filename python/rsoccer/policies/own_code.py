"""Policies that a text "module:name" names: code of one's own that nothing has registered."""

from __future__ import annotations

import os
import re
from typing import Final

from rsoccer import plugins
from rsoccer.policies.base import Policy
from rsoccer.policies.names import check_maker, find, make_with
from rsoccer.policies.policy_file import LOOKAHEAD, SUFFIX
from rsoccer.task import Task

_TEXT: Final = re.compile(r"[A-Za-z_]\w*(\.[A-Za-z_]\w*)*:[A-Za-z_]\w*(\.[A-Za-z_]\w*)*")
_MODES: Final = (":mean", ":sample", f":{LOOKAHEAD}")
"""Endings that choose how a network acts; no policy is found under such a name."""


def is_module_text(text: str) -> bool:
    """Return whether a text has the form "module:name", and stands for nothing else.

    Args:
        text: a name, a path, or a text such as "my_package.teams:keeper".
    """
    if not _TEXT.fullmatch(text) or text.endswith(_MODES) or os.path.exists(text):
        return False
    module = text.partition(":")[0]
    if len(module) == 1:  # a drive of Windows
        return False
    return not module.endswith(SUFFIX) and find(module) is None


def make_from_module(text: str, task: Task) -> Policy:
    """Return the policy that a text names; modules of the current folder come first.

    Args:
        text: "module:name" of a `Policy`, of a subclass of it, or of a function that takes the task
            and returns a policy, as for `register_policy`.
        task: the task that is played.

    Raises:
        ImportError: the module does not exist or raises an error, or has no such name.
        RuntimeError: the maker raises an error other than ValueError.
        ValueError: something else than a policy or its maker has the name, or the maker refuses the
            task or returns something else.
    """
    found = plugins.find("policy", text)
    if isinstance(found, Policy):
        return found
    try:
        check_maker(found)
        return make_with(text, found, task)
    except TypeError as error:
        raise ValueError(
            f"policy: expected {text!r} to name a Policy, its class, or a function of the task "
            f"that returns one: {error}"
        ) from error


def short_name(text: str) -> str:
    """Return the name in a module without the module, for labels and score boards.

    Args:
        text: "module:name".
    """
    return text.partition(":")[2]
