"""Maps over seas: conditions of speed, heading, period and height, their answers, and what guidance says of them."""
