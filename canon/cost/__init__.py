"""What accuracy costs in time: clocks, studies of work and precision, and references that are not what is measured."""
