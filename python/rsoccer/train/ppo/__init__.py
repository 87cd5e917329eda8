"""Proximal policy optimization: advantages, loss, optimizer and schedules."""
