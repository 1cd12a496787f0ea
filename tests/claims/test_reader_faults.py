"""Claim files: what is said of each fault, with its place."""

import pytest

from tests.claims.stated import DEMAND, EULER, OSCILLATOR, PLANE, claim, fault_of


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("", "makes no claim"),
        ("x = ", "line 1, column"),
        ("a = 1\n[b\n", "line 2, column"),
        ("a = [" + "[" * 5000, "nested too deeply"),
        ("a = " + "9" * 5000, "a whole number of more than 4300 digits"),
        (PLANE + f"[symbols]\n{'a' * 5000} = 'real'" + DEMAND, f"[symbols], key '{'a' * 80}': '{'a' * 80}' is not"),
        ("titel = 'x'", "unknown key 'titel': did you mean 'title'?"),
        ("title = 3", "key 'title': a string is expected, not a whole number"),
        ("[claim]\nkind='canonical'", "[[claim]]"),
        (claim("canonical"), "declares its coordinates"),
        ("phase_space = 3" + DEMAND, "a table is expected"),
        ("[phase_space]\nq=['x']\np=['p']\nr=1" + DEMAND, "[phase_space]: unknown key 'r'"),
        ("[phase_space]\nq='x'\np='p'" + DEMAND, "a list is expected, not a string: write it in brackets"),
        ("[phase_space]\nq=['x','y']\np=['p']" + DEMAND, "[phase_space]: q has 2 names but p has 1"),
        ("[phase_space]\nq=['x']\np=['p']\nQ=['X']" + DEMAND, "Q has 1 names but P has 0"),
        ("[phase_space]\nq=['x']\np=['p']\nQ=['X','Y']\nP=['U','V']" + DEMAND, "2 new pairs, but only 1 old ones"),
        ("[phase_space]\nq=[]\np=[]" + DEMAND, "at least one coordinate"),
        ("[phase_space]\nq=['x']\np=['x']" + DEMAND, "'x' is declared already, in [phase_space], q"),
        ("[phase_space]\nq=['x','x']\np=['p','r']" + DEMAND, "'x' is listed twice"),
        ("[phase_space]\nq=['x']\np=['p']\ntime='x'" + DEMAND, "key 'time': 'x' is declared already"),
        ("[phase_space]\nq=['2x']\np=['p']" + DEMAND, "'2x' is not a name"),
        ("[phase_space]\nq=['ﬁ']\np=['p']" + DEMAND, "write 'fi'"),
        ("[phase_space]\nq=[1]\np=['p']" + DEMAND, "a string is expected, not a whole number"),
        (PLANE + "[symbols]\nm='positiv'" + DEMAND, "[symbols], key 'm': unknown assumption 'positiv': did you mean"),
        (PLANE + "[symbols]\nm=['positive','negative']" + DEMAND, "contradict"),
        (PLANE + "[symbols]\nm=['complex','positive']" + DEMAND, "a complex name can only be nonzero"),
        (PLANE + "[symbols]\nV=['function','integer']" + DEMAND, "a function can be positive, negative or nonzero"),
        (PLANE + "[symbols]\nV=['function','positive','negative']" + DEMAND, "a function can be positive, negative or"),
        (PLANE + "[symbols]\nx='function'" + DEMAND, "can't be a function"),
        (PLANE + "[symbols]\nx='integer'" + DEMAND, "can't be an integer"),
        (PLANE + "[symbols]\nm=[1]" + DEMAND, "a string is expected"),
        (PLANE + "[definitions]\nx='px'" + DEMAND, "key 'x': 'x' is declared already, in [phase_space], q"),
        (PLANE + "[symbols]\nm='real'\n[definitions]\nm='1'" + DEMAND, "declared already, in [symbols]"),
        (PLANE + "[definitions]\nt='1'\n[symbols]\nt='real'" + DEMAND, "declared already"),
        (PLANE + "[hamiltonian]\nh='x'" + DEMAND, "unknown key 'h': did you mean 'H'?"),
        (PLANE + "[hamiltonian]" + DEMAND, "the key 'H' is missing"),
        (PLANE + "[hamiltonian]\nH=['x']" + DEMAND, "an expression is expected, as a string, not a list"),
        (PLANE + "[hamiltonian]\nH=true" + DEMAND, "not true or false"),
        (PLANE + "[hamiltonian]\nH=nan" + DEMAND, "the number NaN"),
        (PLANE + "[hamiltonian]\nH=1979-05-27" + DEMAND, "a date or time"),
        (PLANE + "[domain]\nwhere='x>0'" + DEMAND, "a list is expected"),
        (PLANE + "[domain]\nwhere=['x']" + DEMAND, "[domain], key 'where', inequality 1: an inequality is expected"),
        (PLANE + "[domain]\nwhere=['x==0']" + DEMAND, "under `on`"),
        (PLANE + "[domain]\nwhere=['u>0']" + DEMAND, "unknown name 'u'"),
        (PLANE + "[domain]\nwhere=['1<0']" + DEMAND, "can't hold"),
        (PLANE + "[domain]\non=['1']" + DEMAND, "the surface is empty"),
        (PLANE + "[transformation]\nQ=['x']\nP=['px']" + DEMAND, "declares no new variables"),
        (PLANE + DEMAND + "[[claim]]\n", "claim 2: the key 'kind' is missing"),
        (PLANE + claim("conservd", "f='x'"), "claim 1, key 'kind': unknown kind 'conservd': did you mean 'conserved'?"),
        (PLANE + claim("conserved", "f='x'"), "needs a Hamiltonian: add [hamiltonian] with H"),
        (PLANE + claim("canonical"), "needs a map"),
        (PLANE + claim("generates"), "needs a generating function"),
        (PLANE + claim("bracket", "f='x'\ng='y'\nequal='0'"), "unknown key 'equal': did you mean 'equals'?"),
        (PLANE + claim("bracket", "f='x'\ng='y'"), "claim 1: a claim of kind 'bracket' needs the key 'equals'"),
        (PLANE + claim("involution", "functions=[]"), "the list is empty"),
        (PLANE + claim("involution", "functions=['x','u']"), "claim 1, key 'functions', entry 2: unknown name 'u'"),
        (PLANE + claim("infinitesimal", "generator='x'\ndq=['1']\ndp=['0','0']"), "1 components for the 2 degrees"),
        (PLANE + claim("identity", "lhs='x'\nrhs='x'\nexpect='yes'"), "unknown expectation 'yes'"),
        (PLANE + claim("identity", "lhs='x'\nrhs='x'\nbudget=-1"), "a positive number of seconds"),
        (PLANE + claim("identity", "lhs='x'\nrhs='x'\nbudget='1'"), "a positive number of seconds"),
        (PLANE + claim("identity", "lhs='1/0'\nrhs='x'"), "undefined everywhere"),
        (PLANE + claim("identity", "lhs='x'\nrhs='log(-1)'"), "undefined everywhere"),
        (PLANE + claim("identity", "lhs='__import__(1)'\nrhs='x'"), "unknown name '__import__'"),
        (OSCILLATOR + claim("new_hamiltonian", "K='q'"), "'q' at column 1 is out of place: this is a formula of"),
        (OSCILLATOR + claim("new_hamiltonian", "K='E0'"), "in the definition 'E0'"),
        (OSCILLATOR + claim("new_hamiltonian", "K='bracket(phi, I)'"), "'bracket' at column 1 is out of place"),
        (OSCILLATOR + claim("bracket", "f='q'\ng='I'\nequals='0'"), "key 'g': 'I' at column 1 is out of place"),
        (OSCILLATOR + claim("bracket", "f='q'\ng='1j*II'\nequals='0'"), "did you mean 'I'?"),
        (OSCILLATOR + claim("canonical", "scale='q'"), "this is an expression in parameters alone"),
        (OSCILLATOR + claim("canonical", "scale='t'"), "this is an expression in parameters alone"),
        (OSCILLATOR + claim("canonical", "order=2"), "a list is expected"),
        (OSCILLATOR + claim("canonical", "order=['q',2]"), "'q' is a variable of [phase_space]"),
        (OSCILLATOR + claim("canonical", "order=['eps',2.5]"), "a whole number is expected"),
        (OSCILLATOR + claim("canonical", "order=['eps',-2]"), "an order from 0 to 40"),
        (OSCILLATOR + claim("integral_invariant", "order=2"), "a whole number from 1 to 1"),
        (OSCILLATOR + claim("generating_function", "type=5\nF='q'"), "there is no type 5"),
        (OSCILLATOR + claim("generating_function", "type=[1,2]\nF='q'"), "2 types for 1 degrees of freedom"),
        (OSCILLATOR + claim("generating_function", "type=2\nF='q*phi'"), "a generating function of the variables q, I"),
        (OSCILLATOR + claim("generating_function", "type=1\nF='bracket(q,p)'"), "'p' at column 11 is out of place"),
        (OSCILLATOR + claim("canonical_when", "solutions=[]"), "at least one table"),
        (OSCILLATOR + claim("canonical_when", "solutions=[{}]"), "the table is empty"),
        (OSCILLATOR + claim("canonical_when", "solutions=[{mm=1}]"), "table 1: unknown name 'mm'"),
        (OSCILLATOR + claim("canonical_when", "solutions=[{E0=1}]"), "'E0' is a function or an abbreviation, not a"),
        (OSCILLATOR + claim("canonical_when", "solutions=[{q=1}]"), "'q' is a variable of [phase_space]"),
        (OSCILLATOR + claim("canonical_when", "solutions=[{m='q'}]"), "in parameters alone"),
        (OSCILLATOR + claim("legendre", "L='p'\nvelocities=['v']"), "of velocities and of the coordinates q, v"),
        (OSCILLATOR + claim("legendre", "L='v'\nvelocities=['v','w']"), "2 names for 1 coordinates"),
        (OSCILLATOR + claim("legendre", "L='v'\nvelocities=['q']"), "'q' is a variable"),
        (OSCILLATOR + claim("lie_series", "f='q'\ngenerator='p'\nequals='q'\nparameter='p'"), "'p' is a variable"),
    ],
)  # fmt: skip
def test_faults(text, message):
    assert message in fault_of(text)


def test_both_directions_and_wrong_counts():
    head = OSCILLATOR.split("[transformation]")[0]
    both = '[transformation]\nQ=["q"]\nP=["p"]\nq=["phi"]\np=["I"]\n'
    assert "both directions" in fault_of(head + both + claim("canonical"))
    assert "key 'P' is missing" in fault_of(head + '[transformation]\nQ=["q"]\n' + claim("canonical"))
    wrong = '[transformation]\nQ=["q", "p"]\nP=["p"]\n'
    assert "key 'Q': 2 components for the 1 variables phi" in fault_of(head + wrong + claim("canonical"))
    old = '[transformation]\nq=["q"]\np=["I"]\n'
    assert "'q' at column 1 is out of place: this is a formula of the new" in fault_of(head + old + claim("canonical"))


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        (EULER.replace('"L2", "-L1"', '"L2", "L1"'), "not antisymmetric: row 2, column 3 and row 3, column 2"),
        (EULER.replace(', "L3"]', "]"), "2 rows of 2 expressions"),
        ('tensor = [[0]]', "needs the key 'coordinates'"),
        (EULER.replace("[0, ", "[0, 0, "), "3 rows of 3 expressions"),
        (EULER.replace('"L3", "-L2"', '"x", "-L2"'), "row 1, column 2: 'x' at column 1 is out of place"),
        ('structure = {"L1,L2" = "L1*L2"}', "a linear combination"),
        ('structure = {"L1,L2" = "L3"}', "unknown name 'L3' at column 1"),
        ('structure = {"L1,L2" = "L1", "L2,L1" = "L1"}', "stated twice"),
        ('structure = {"L1" = "L1"}', "a pair of basis names"),
    ],
)  # fmt: skip
def test_faults_in_a_tensor(keys, message):
    assert message in fault_of(PLANE + claim("bracket", keys + '\nf="L1"\ng="L1"\nequals="0"'))
