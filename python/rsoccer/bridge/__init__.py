"""The simulator on the network: sockets, clocks, watchdogs and identities of teams' software.

`rsoccer.protocols` converts messages; this package decides who may send them, and when.
"""
