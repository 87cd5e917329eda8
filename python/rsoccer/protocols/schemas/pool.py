"""Message classes from serialized schemas, in a pool of descriptors of their own.

Modules that protoc writes register in the default pool, where two files or messages of one name
exclude each other, and need a runtime at least as new as protoc. This module uses a private pool
and public functions of the runtime only, so any version since the bound in pyproject.toml works,
and a program may load the leagues' own modules too.
"""

from types import ModuleType
from typing import Any, Final

from rsoccer.protocols.protobuf import (
    EnumTypeWrapper,
    FileDescriptor,
    any_pb2,
    descriptor_pb2,
    descriptor_pool,
    message_factory,
)

_POOL: Final = descriptor_pool.DescriptorPool()
_POOL.AddSerializedFile(any_pb2.DESCRIPTOR.serialized_pb)  # the only file of protobuf's in use


def load(serialized: bytes, *needed: ModuleType) -> dict[str, Any]:
    """Register a schema and return what its module contains.

    Args:
        serialized: a serialized `FileDescriptorProto`.
        *needed: modules of the schemas that it imports. Importing them registered them.

    Returns:
        Message classes, enumerations and values of enumerations by name, and the file's descriptor
        as `DESCRIPTOR`.
    """
    name = descriptor_pb2.FileDescriptorProto.FromString(serialized).name
    _POOL.AddSerializedFile(serialized)
    descriptor: FileDescriptor = _POOL.FindFileByName(name)
    contents: dict[str, Any] = {"DESCRIPTOR": descriptor}
    for message in descriptor.message_types_by_name.values():
        contents[message.name] = message_factory.GetMessageClass(message)
    for enum in descriptor.enum_types_by_name.values():
        contents[enum.name] = EnumTypeWrapper(enum)
        contents.update({value.name: value.number for value in enum.values})
    return contents
