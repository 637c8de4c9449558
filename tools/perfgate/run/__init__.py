"""Starting the programs that are compared, and keeping their times."""
