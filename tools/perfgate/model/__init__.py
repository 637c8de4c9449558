"""What a run is made of: configuration, measurements, report. Pure functions."""
