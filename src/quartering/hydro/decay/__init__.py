"""Free decay records: read, analysed, and made the added roll damping of a ship."""
