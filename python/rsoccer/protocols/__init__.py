"""Messages of the leagues' protocols, without sockets."""
