"""Lines of a hull: sections, contours, stations, and the points and panels that pressure is integrated over."""
