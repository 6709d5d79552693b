"""What a page computes, in turns: jobs of visitors, their queue, and the guard before them."""
