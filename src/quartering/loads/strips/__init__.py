"""Wave forces by strip theory: Froude-Krylov and diffraction, section by section."""
