"""The functions that run the commands of `derive`; each module contains one command or a group of related commands."""
