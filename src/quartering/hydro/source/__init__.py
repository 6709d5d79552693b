"""Sources of added mass, damping and wave forces behind one record: strips, panels, a database."""
