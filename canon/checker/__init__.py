"""A small checker of certificates: parser, derivatives and arithmetic are its own, no code of the deciders is used."""
