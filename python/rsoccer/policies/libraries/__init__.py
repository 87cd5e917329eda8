"""Policies of models that other libraries have trained, one line each.

>>> from rsoccer.policies.libraries import from_sb3  # doctest: +SKIP
>>> policy = from_sb3(model)  # doctest: +SKIP
>>> rsoccer.evaluate(policy, "ou", task="VSS-v0")  # doctest: +SKIP
>>> policy.save("policy.safetensors")  # doctest: +SKIP

Each function returns a `Network` with a copy of the weights and with the normalization of the
observations. It imports nothing but the library whose model it gets.
"""

from rsoccer.policies.libraries.cleanrl import from_cleanrl
from rsoccer.policies.libraries.rllib import from_rllib
from rsoccer.policies.libraries.sb3 import from_sb3
from rsoccer.policies.libraries.torchrl import from_torchrl

__all__ = ["from_cleanrl", "from_rllib", "from_sb3", "from_torchrl"]
