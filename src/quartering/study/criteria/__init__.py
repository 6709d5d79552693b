"""Second-generation intact stability: five failure modes, one file each; the circular's constants and sea states as data."""
