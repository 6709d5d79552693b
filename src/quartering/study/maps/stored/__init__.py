"""The store of a study on disk: blocks, their check sums, and a copy in another format."""
