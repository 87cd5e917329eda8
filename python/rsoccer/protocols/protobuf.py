"""The names of protobuf that this package uses, with an error that tells how to install it."""

try:
    from google.protobuf import any_pb2, descriptor_pb2, descriptor_pool, message_factory
    from google.protobuf.descriptor import Descriptor, FieldDescriptor, FileDescriptor
    from google.protobuf.internal.enum_type_wrapper import EnumTypeWrapper
    from google.protobuf.message import DecodeError, Message
except ImportError as error:
    raise ImportError("rsoccer.protocols needs protobuf: pip install 'rsoccer[network]'") from error

__all__ = [
    "DecodeError",
    "Descriptor",
    "EnumTypeWrapper",
    "FieldDescriptor",
    "FileDescriptor",
    "Message",
    "any_pb2",
    "descriptor_pb2",
    "descriptor_pool",
    "message_factory",
]
