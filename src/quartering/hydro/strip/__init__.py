"""Strip theory: section coefficients over the length, three-dimensional end corrections, six modes."""
