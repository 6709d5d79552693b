"""What the wave does: kinematics, Froude-Krylov force, diffraction."""
