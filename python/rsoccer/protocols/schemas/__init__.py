"""Messages of the leagues' protocols as protobuf classes: one module for each schema.

`vision_pb2`, `tracker_pb2`, `referee_pb2`, `simulation_pb2`, `grsim_pb2`, `fira_pb2` and
`vssref_pb2` are made from the `.proto` files beside them by `python -m tools.make_schemas`.
"""
