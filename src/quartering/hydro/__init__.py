"""What the water does to a moving hull: sections, strips, roll damping, manoeuvring derivatives."""
