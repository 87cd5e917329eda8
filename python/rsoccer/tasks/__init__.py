"""Tasks of the package, one module each. Importing this package registers them."""

from rsoccer.registry import register
from rsoccer.tasks import legacy_names
from rsoccer.tasks.ssl_contested_possession import SslContestedPossession
from rsoccer.tasks.ssl_dribbling import SslDribbling
from rsoccer.tasks.ssl_go_to_ball import SslGoToBall
from rsoccer.tasks.ssl_keepaway import SslKeepaway
from rsoccer.tasks.ssl_match import SslMatch
from rsoccer.tasks.ssl_pass_endurance import SslPassEndurance
from rsoccer.tasks.ssl_pass_endurance_multi import SslPassEnduranceMulti
from rsoccer.tasks.ssl_self_play import SslSelfPlay
from rsoccer.tasks.ssl_static_defenders import SslStaticDefenders
from rsoccer.tasks.vss_match import VssMatch
from rsoccer.tasks.vss_multi import VssMulti
from rsoccer.tasks.vss_self_play import VssSelfPlay
from rsoccer.tasks.vss_single import VssSingle

__all__ = [
    "SslContestedPossession",
    "SslDribbling",
    "SslGoToBall",
    "SslKeepaway",
    "SslMatch",
    "SslPassEndurance",
    "SslPassEnduranceMulti",
    "SslSelfPlay",
    "SslStaticDefenders",
    "VssMatch",
    "VssMulti",
    "VssSelfPlay",
    "VssSingle",
]

register("VSS-v0", VssSingle)
register("VSSMulti-v0", VssMulti)
register("VSSSelfPlay-v0", VssSelfPlay)
register("SSLGoToBall-v0", SslGoToBall)
register("SSLStaticDefenders-v0", SslStaticDefenders)
register("SSLContestedPossession-v0", SslContestedPossession)
register("SSLDribbling-v0", SslDribbling)
register("SSLPassEndurance-v1", SslPassEndurance)
register("SSLPassEnduranceMulti-v1", SslPassEnduranceMulti)
register("SSLKeepaway-v0", SslKeepaway)
register("SSLSelfPlay-v0", SslSelfPlay)
register("VSSMatch-v0", VssMatch)
register("SSLMatch-v0", SslMatch)
legacy_names.register_aliases()
