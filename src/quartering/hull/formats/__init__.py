"""Lines in files of other programs: offset tables, PDSTRIP, GDF, STL."""
