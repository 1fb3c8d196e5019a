"""Pages and pictures of the book that are made by programs."""
