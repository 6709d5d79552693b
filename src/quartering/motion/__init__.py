"""The equations of motion and their periodic and transient solutions."""
