"""Policy network and value network, their shared weights and what they read."""
