"""The tasks that come with the package, one file each; importing this registers them."""

from rsoccer.registry import register
from rsoccer.tasks.vss_multi import VssMulti
from rsoccer.tasks.vss_self_play import VssSelfPlay
from rsoccer.tasks.vss_single import VssSingle

__all__ = ["VssMulti", "VssSelfPlay", "VssSingle"]

register("VSS-v0", VssSingle)
register("VSSMulti-v0", VssMulti)
register("VSSSelfPlay-v0", VssSelfPlay)
