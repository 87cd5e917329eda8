"""Rollouts: matches with the current policy, recorded as samples."""
