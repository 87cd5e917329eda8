"""Environments for PettingZoo and Gymnasium; `rsoccer` exports their constructors."""
