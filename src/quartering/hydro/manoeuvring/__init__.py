"""Forces of steady motion: lift, cross-flow drag, rudder, measured derivatives."""
