"""Laws for all inputs, and campaigns that look for wrong verdicts."""
