From Coq Require Import Reals Lra List ZArith Lia QArith Qreals Ring_polynom InitialRing RealField.
Import ListNotations.
Open Scope R_scope.

(* A procedure that sees whether formulas are 0, and the proof that it is right (Lemma vanishing).

   A formula is a rational function of variables, of which some satisfy g ^ n = polynomial (a root, a sine beside its
   cosine), and of quantities that are defined one after another. Each is brought into the form polynomial times powers
   of given divisors, none of which is 0; polynomials are those of the library (Ring_polynom), with rational
   coefficients, and powers g ^ n are replaced. A formula with the polynomial 0 is 0. *)
(* Rational numbers as coefficients; whole ones stay so. *)
Definition whole (a b : Q) (f : Z -> Z -> Z) (g : Q) : Q :=
  match Qden a, Qden b with xH, xH => Qmake (f (Qnum a) (Qnum b)) 1 | _, _ => Qred g end.
Definition q_plus a b := whole a b Z.add (a + b)%Q.
Definition q_mult a b := whole a b Z.mul (a * b)%Q.
Definition q_minus a b := q_plus a (Qopp b).

Lemma q_plus_is a b : Q2R (q_plus a b) = Q2R a + Q2R b.
Proof.
  rewrite <- Q2R_plus. unfold q_plus, whole. apply Qeq_eqR.
  destruct a as [n d], b as [m e]; cbn [Qden Qnum]; destruct d, e; try apply Qred_correct; unfold Qeq; cbn; lia.
Qed.
Lemma q_mult_is a b : Q2R (q_mult a b) = Q2R a * Q2R b.
Proof.
  rewrite <- Q2R_mult. unfold q_mult, whole. apply Qeq_eqR.
  destruct a as [n d], b as [m e]; cbn [Qden Qnum]; destruct d, e; try apply Qred_correct; unfold Qeq; cbn; lia.
Qed.
Lemma q_minus_is a b : Q2R (q_minus a b) = Q2R a - Q2R b.
Proof. unfold q_minus. rewrite q_plus_is, Q2R_opp. reflexivity. Qed.
Lemma q_equal a b : Qeq_bool a b = true -> Q2R a = Q2R b.
Proof. intro. apply Qeq_eqR, Qeq_bool_eq. assumption. Qed.
Lemma q_zero : Q2R 0 = 0. Proof. unfold Q2R; simpl; lra. Qed.
Lemma q_one : Q2R 1 = 1. Proof. unfold Q2R; simpl; lra. Qed.
Definition q_morph :
  ring_morph 0 1 Rplus Rmult Rminus Ropp eq 0%Q 1%Q q_plus q_mult q_minus Qopp Qeq_bool Q2R :=
  mkmorph 0 1 Rplus Rmult Rminus Ropp eq 0%Q 1%Q q_plus q_mult q_minus Qopp Qeq_bool Q2R
    q_zero q_one q_plus_is q_minus_is q_mult_is Q2R_opp q_equal.
Definition r_ext : ring_eq_ext Rplus Rmult Ropp eq := Eq_ext Rplus Rmult Ropp.
Definition r_ring := Rth_ARth (Eqsth R) r_ext RTheory.
Definition q_div := triv_div 0%Q 1%Q Qeq_bool.
Definition q_div_is : div_theory eq q_plus q_mult Q2R q_div := triv_div_th (Eqsth R) r_ext r_ring q_morph.

Definition poly := Pol Q.
Definition value_at : list R -> poly -> R := Pphi 0 Rplus Rmult Q2R.
Definition add : poly -> poly -> poly := Padd 0%Q q_plus Qeq_bool.
Definition mul : poly -> poly -> poly := Pmul 0%Q 1%Q q_plus q_mult Qeq_bool.
Definition same : poly -> poly -> bool := Peq Qeq_bool.
Definition variable : positive -> poly := mk_X 0%Q 1%Q.
Definition rules := list (Q * Mon * poly).
Definition reduce (e : rules) (p : poly) : poly := PNSubstL 0%Q 1%Q q_plus q_mult Qeq_bool q_div p e 30 30.

Lemma add_is p q l : value_at l (add p q) = value_at l p + value_at l q.
Proof. apply (Padd_ok (Eqsth R) r_ext r_ring q_morph). Qed.
Lemma mul_is p q l : value_at l (mul p q) = value_at l p * value_at l q.
Proof. apply (Pmul_ok (Eqsth R) r_ext r_ring q_morph). Qed.
Lemma same_is p q l : same p q = true -> value_at l p = value_at l q.
Proof. intro. apply (Peq_ok (Eqsth R) r_ext q_morph). assumption. Qed.
Lemma variable_is k l : value_at l (variable k) = BinList.nth 0 k l.
Proof. symmetry. apply (mkX_ok (Eqsth R) r_ext r_ring q_morph). Qed.
Definition true_at (l : list R) (e : rules) : Prop := MPcond 0 1 Rplus Rmult eq Q2R e l.
Lemma reduce_is e p l : true_at l e -> value_at l (reduce e p) = value_at l p.
Proof. intro. symmetry. apply (PNSubstL_ok (Eqsth R) r_ext r_ring q_morph q_div_is). assumption. Qed.

(* Terms in variables and in quantities defined before, `Mid k`; their values. *)
Inductive term :=
  | Num (z : Z) | Var (k : positive) | Mid (k : nat) | Add (a b : term) | Mul (a b : term) | Opp (a : term)
  | Inv (a : term) | Pow (a : term) (n : nat).
Fixpoint eval (l mids : list R) (t : term) : R :=
  match t with
  | Num z => IZR z
  | Var k => BinList.nth 0 k l
  | Mid k => nth k mids 0
  | Add a b => eval l mids a + eval l mids b
  | Mul a b => eval l mids a * eval l mids b
  | Opp a => - eval l mids a
  | Inv a => / eval l mids a
  | Pow a n => eval l mids a ^ n
  end.

(* A fraction: a polynomial times powers of the divisors, of which none is 0. *)
Definition fraction := (poly * list Z)%type.
Fixpoint powers (l : list R) (ds : list poly) (z : list Z) : R :=
  match ds, z with d :: ds, n :: z => powerRZ (value_at l d) n * powers l ds z | _, _ => 1 end.
Definition at_ (l : list R) (ds : list poly) (f : fraction) : R := value_at l (fst f) * powers l ds (snd f).
Definition none_is_0 (l : list R) (ds : list poly) : Prop := Forall (fun d => value_at l d <> 0) ds.

Section Normal.
Variable e : rules.
Variable ds : list poly.
Definition nmul p q := reduce e (mul p q).
Fixpoint npow p n := match n with O => Pc 1%Q | S n => nmul p (npow p n) end.
Definition zeros : list Z := map (fun _ => 0%Z) ds.
Fixpoint sum (x y : list Z) : list Z :=
  match x, y with a :: x, b :: y => (a + b)%Z :: sum x y | [], _ => y | _, [] => x end.
Fixpoint least (x y : list Z) : list Z :=
  match x, y with a :: x, b :: y => Z.min a b :: least x y | _, _ => [] end.
Fixpoint lift (ds : list poly) (x y : list Z) (p : poly) : option poly :=
  match ds, x, y with
  | d :: ds, a :: x, b :: y =>
      match lift ds x y p with
      | Some p => if (b <=? a)%Z then Some (if (b =? a)%Z then p else nmul (npow d (Z.to_nat (a - b))) p) else None
      | None => None
      end
  | [], _, _ => Some p
  | _, _, _ => None
  end.
Definition f_add (f g : fraction) : option fraction :=
  let m := least (snd f) (snd g) in
  match lift ds (snd f) m (fst f), lift ds (snd g) m (fst g) with
  | Some p, Some q => Some (add p q, m)
  | _, _ => None
  end.
Definition f_mul (f g : fraction) : fraction := (nmul (fst f) (fst g), sum (snd f) (snd g)).
Fixpoint f_pow f n : fraction := match n with O => (Pc 1%Q, zeros) | S n => f_mul f (f_pow f n) end.
Fixpoint lead (p : poly) : Q := match p with Pc c => c | Pinj _ p => lead p | PX p _ _ => lead p end.
(* Whether f is a number times these powers of the divisors: then this number. *)
Definition product (z : list Z) (f : fraction) : option Q :=
  let m := least z (snd f) in
  match lift ds (snd f) m (fst f), lift ds z m (Pc 1%Q) with
  | Some p, Some q =>
      let c := Qred (lead p / lead q) in
      if same p (mul q (Pc c)) then if Qeq_bool c 0 then None else Some c else None
  | _, _ => None
  end.
Definition with_product (z : list Z) (f : fraction) : option fraction :=
  match z with
  | [] => Some f
  | _ => match product z f with Some c => Some (Pc c, z) | None => None end
  end.
Definition negated (z : list Z) : list Z := map Z.opp z.
Fixpoint units (before : list Z) (ds : list poly) : list (list Z) :=
  match ds with [] => [] | _ :: ds => (before ++ 1%Z :: map (fun _ => 0%Z) ds) :: units (0%Z :: before) ds end.
Definition all_units := zeros :: units [] ds.
Definition f_inv (f : fraction) : option fraction :=
  match fst f with
  | Pc c => if Qeq_bool c 0 then None else Some (Pc (Qred (/ c)), negated (snd f))
  | _ =>
    (fix try_ us := match us with
      | [] => None
      | u :: us => let z := sum u (snd f) in
          match product z f with Some c => Some (Pc (Qred (/ c)), negated z) | None => try_ us end
      end) all_units
  end.
Fixpoint normal (known : list fraction) (t : term) : option fraction :=
  match t with
  | Num z => Some (Pc (Qmake z 1), zeros)
  | Var k => Some (reduce e (variable k), zeros)
  | Mid k => nth_error known k
  | Add a b => match normal known a, normal known b with Some f, Some g => f_add f g | _, _ => None end
  | Mul a b => match normal known a, normal known b with Some f, Some g => Some (f_mul f g) | _, _ => None end
  | Opp a => match normal known a with Some f => Some (f_mul (Pc (-1)%Q, zeros) f) | None => None end
  | Inv a => match normal known a with Some f => f_inv f | None => None end
  | Pow a n => match normal known a with Some f => Some (f_pow f n) | None => None end
  end.

Variable l : list R.
Hypothesis good : true_at l e.
Hypothesis nonzero_ : none_is_0 l ds.
Notation at' := (at_ l ds).

Lemma constant_is c : value_at l (Pc c) = Q2R c. Proof. reflexivity. Qed.
Lemma nmul_is p q : value_at l (nmul p q) = value_at l p * value_at l q.
Proof. unfold nmul. rewrite reduce_is, mul_is by assumption. reflexivity. Qed.
Lemma npow_is p n : value_at l (npow p n) = value_at l p ^ n.
Proof. induction n; cbn [npow pow]; [apply q_one | rewrite nmul_is, IHn; reflexivity]. Qed.
Lemma zeros_is ds' : powers l ds' (map (fun _ => 0%Z) ds') = 1.
Proof. induction ds'; simpl; [|rewrite IHds']; lra. Qed.
Lemma sum_is ds' : none_is_0 l ds' -> forall x y, powers l ds' (sum x y) = powers l ds' x * powers l ds' y.
Proof.
  induction 1 as [|d ds' H _ IH]; intros [|a x] [|b y]; simpl; try lra.
  rewrite IH, powerRZ_add by assumption. ring.
Qed.
Lemma lift_is ds' : none_is_0 l ds' -> forall x y p q,
  lift ds' x y p = Some q -> value_at l q * powers l ds' y = value_at l p * powers l ds' x.
Proof.
  induction 1 as [|d ds' H _ IH]; intros x y p q E.
  - simpl in *. injection E as ->. reflexivity.
  - destruct x as [|a x], y as [|b y]; simpl in E; try discriminate.
    destruct (lift ds' x y p) as [p'|] eqn:L; try discriminate. apply IH in L.
    destruct (Z.leb_spec b a); try discriminate. injection E as <-. cbn [powers].
    destruct (Z.eqb_spec b a) as [->|].
    + replace (value_at l p * (powerRZ (value_at l d) a * powers l ds' x))
        with (powerRZ (value_at l d) a * (value_at l p * powers l ds' x)) by ring. rewrite <- L. ring.
    + rewrite nmul_is, npow_is. replace (powerRZ (value_at l d) a)
        with (value_at l d ^ Z.to_nat (a - b) * powerRZ (value_at l d) b).
      * replace (value_at l p * (value_at l d ^ Z.to_nat (a - b) * powerRZ (value_at l d) b * powers l ds' x))
          with (value_at l d ^ Z.to_nat (a - b) * powerRZ (value_at l d) b * (value_at l p * powers l ds' x)) by ring.
        rewrite <- L. ring.
      * rewrite pow_powerRZ, <- powerRZ_add by assumption. f_equal. lia.
Qed.
Lemma f_add_is f g h : f_add f g = Some h -> at' h = at' f + at' g.
Proof.
  unfold f_add, at_. destruct (lift _ (snd f) _ _) as [p|] eqn:P; try discriminate.
  destruct (lift _ (snd g) _ _) as [q|] eqn:Q; try discriminate. injection 1 as <-. cbn [fst snd].
  apply lift_is in P, Q; try assumption. rewrite add_is, Rmult_plus_distr_r, P, Q. reflexivity.
Qed.
Lemma f_mul_is f g : at' (f_mul f g) = at' f * at' g.
Proof. unfold f_mul, at_. cbn [fst snd]. rewrite nmul_is, sum_is by assumption. ring. Qed.
Lemma f_pow_is f n : at' (f_pow f n) = at' f ^ n.
Proof.
  induction n; cbn [f_pow pow]; [|rewrite f_mul_is, IHn; reflexivity].
  unfold at_, zeros. cbn [fst snd]. rewrite zeros_is, constant_is, q_one. ring.
Qed.
Lemma powers_not_0 ds' : none_is_0 l ds' -> forall z, powers l ds' z <> 0.
Proof.
  induction 1; intros [|n z]; simpl; try lra.
  apply Rmult_integral_contrapositive_currified; [apply powerRZ_NOR; assumption | apply IHForall].
Qed.
Lemma product_is z f c : product z f = Some c -> at' f = Q2R c * powers l ds z /\ Q2R c <> 0.
Proof.
  unfold product. destruct (lift _ (snd f) _ _) as [p|] eqn:P; try discriminate.
  destruct (lift _ z _ _) as [q|] eqn:Q; try discriminate. cbv zeta.
  set (r := Qred (lead p / lead q)). clearbody r. destruct (same _ _) eqn:E; try discriminate.
  destruct (Qeq_bool _ 0) eqn:Z; try discriminate. injection 1 as <-. apply lift_is in P, Q; try assumption.
  apply same_is with (l := l) in E.
  rewrite mul_is, constant_is in E. rewrite constant_is, q_one, Rmult_1_l in Q. split.
  - unfold at_. rewrite <- P, E, <- Q. ring.
  - intro H. rewrite <- RMicromega.Q2R_0 in H. apply eqR_Qeq in H. apply Qeq_bool_iff in H.
    rewrite H in Z. discriminate.
Qed.
Lemma with_product_is z f g : with_product z f = Some g -> at' g = at' f.
Proof.
  destruct z as [|n z]; unfold with_product; [now injection 1 as ->|].
  destruct (product (n :: z) f) eqn:E; try discriminate.
  injection 1 as <-. apply product_is in E. unfold at_ at 1. cbn [fst snd]. rewrite constant_is. symmetry. apply E.
Qed.
Lemma negated_is ds' : none_is_0 l ds' -> forall z, powers l ds' (negated z) = / powers l ds' z.
Proof.
  induction 1 as [|d ds' H F IH]; intros [|n z]; cbn [negated map powers]; try (field; lra).
  unfold negated in IH. rewrite IH. pose proof (powers_not_0 ds' F z). pose proof (pow_nonzero _ (Pos.to_nat 1) H).
  destruct n as [|n|n]; cbn [powerRZ Z.opp]; try pose proof (pow_nonzero _ (Pos.to_nat n) H); field; auto.
Qed.
Lemma inverse_is c z : Q2R c <> 0 -> at' (Pc (Qred (/ c)), negated z) = / (Q2R c * powers l ds z).
Proof.
  intro H. unfold at_. cbn [fst snd]. rewrite constant_is, negated_is by assumption.
  rewrite (Qeq_eqR _ _ (Qred_correct (/ c))), Q2R_inv, Rinv_mult; try reflexivity.
  intro E. apply H. rewrite (Qeq_eqR _ _ E). apply q_zero.
Qed.
Lemma not_0 c : Qeq_bool c 0 = false -> Q2R c <> 0.
Proof.
  intros Z H. rewrite <- RMicromega.Q2R_0 in H. apply eqR_Qeq in H. apply Qeq_bool_iff in H. congruence.
Qed.
Lemma f_inv_is f g : f_inv f = Some g -> at' g = / at' f.
Proof.
  assert (T : (fix try_ us := match us with
      | [] => None
      | u :: us => let z := sum u (snd f) in
          match product z f with Some c => Some (Pc (Qred (/ c)), negated z) | None => try_ us end
      end) all_units = Some g -> at' g = / at' f).
  { induction all_units as [|u us IH]; try discriminate. cbv zeta.
    destruct (product _ f) as [c|] eqn:E; try assumption. injection 1 as <-. apply product_is in E as [E N].
    rewrite inverse_is, E by assumption. reflexivity. }
  unfold f_inv. destruct (fst f) as [c|j p|p i q] eqn:F; try assumption.
  destruct (Qeq_bool c 0) eqn:Z; try discriminate. injection 1 as <-. rewrite inverse_is by (apply not_0; assumption).
  unfold at_ at 1. rewrite F. reflexivity.
Qed.

Definition agree (mids : list R) (known : list fraction) : Prop :=
  forall k f, nth_error known k = Some f -> nth k mids 0 = at' f.
Lemma normal_is mids known : agree mids known -> forall t f, normal known t = Some f -> eval l mids t = at' f.
Proof.
  intros A t. induction t as [z|k|k|a IHa b IHb|a IHa b IHb|a IHa|a IHa|a IHa n]; intros f; cbn [normal eval].
  - injection 1 as <-. unfold at_, zeros. cbn [fst snd]. rewrite zeros_is, constant_is. unfold Q2R; simpl. field.
  - injection 1 as <-. unfold at_, zeros. cbn [fst snd]. rewrite zeros_is, reduce_is, variable_is by assumption. ring.
  - apply A.
  - destruct (normal known a), (normal known b); try discriminate. intro H. apply f_add_is in H.
    rewrite (IHa _ eq_refl), (IHb _ eq_refl), H. reflexivity.
  - destruct (normal known a), (normal known b); try discriminate. injection 1 as <-.
    rewrite (IHa _ eq_refl), (IHb _ eq_refl), f_mul_is. reflexivity.
  - destruct (normal known a); try discriminate. injection 1 as <-. rewrite (IHa _ eq_refl), f_mul_is.
    unfold at_ at 2, zeros. cbn [fst snd]. rewrite zeros_is, constant_is. unfold Q2R; simpl. field.
  - destruct (normal known a); try discriminate. intro H. apply f_inv_is in H. rewrite (IHa _ eq_refl), H. reflexivity.
  - destruct (normal known a); try discriminate. injection 1 as <-. rewrite (IHa _ eq_refl), f_pow_is. reflexivity.
Qed.

(* Quantities defined one after another, each perhaps known to be a product; then terms that are 0. *)
Fixpoint holds (mids : list R) (k : nat) (defs : list (term * list Z)) : Prop :=
  match defs with [] => True | (t, _) :: defs => nth k mids 0 = eval l mids t /\ holds mids (S k) defs end.
Fixpoint run (known : list fraction) (defs : list (term * list Z)) : option (list fraction) :=
  match defs with
  | [] => Some known
  | (t, z) :: defs =>
      match normal known t with
      | Some f => match with_product z f with Some f => run (known ++ [f]) defs | None => None end
      | None => None
      end
  end.
Lemma run_is mids defs : forall known known', agree mids known -> holds mids (length known) defs ->
  run known defs = Some known' -> agree mids known'.
Proof.
  induction defs as [|[t z] defs IH]; intros known known' A H; cbn [run].
  - injection 1 as <-. assumption.
  - destruct (normal known t) as [f|] eqn:N; try discriminate.
    destruct (with_product z f) as [g|] eqn:G; try discriminate. destruct H as [H H'].
    apply IH.
    + intros k h. destruct (Nat.lt_ge_cases k (length known)).
      * rewrite nth_error_app1 by assumption. apply A.
      * rewrite nth_error_app2 by assumption. destruct (k - length known)%nat eqn:D; [|destruct n; discriminate].
        injection 1 as <-. replace k with (length known) by lia. rewrite H, (with_product_is _ _ _ G).
        apply (normal_is _ _ A _ _ N).
    + rewrite app_length, Nat.add_comm. assumption.
Qed.
Definition zero (f : fraction) : bool := same (fst f) (Pc 0%Q).
Definition vanish (defs : list (term * list Z)) (goals : list term) : bool :=
  match run [] defs with
  | Some known => forallb (fun t => match normal known t with Some f => zero f | None => false end) goals
  | None => false
  end.
Lemma vanish_is mids defs goals : holds mids 0 defs -> vanish defs goals = true ->
  Forall (fun t => eval l mids t = 0) goals.
Proof.
  unfold vanish. intros H. destruct (run [] defs) as [known|] eqn:E; try discriminate. intro V.
  apply run_is with (mids := mids) in E; try assumption; [|intros [|k] f; discriminate].
  apply Forall_forall. intros t I. apply (proj1 (forallb_forall _ _) V) in I.
  destruct (normal known t) as [f|] eqn:N; try discriminate. apply same_is with (l := l) in I.
  rewrite (normal_is _ _ E _ _ N). unfold at_. rewrite I, constant_is, q_zero. ring.
Qed.
End Normal.

(* Relations g ^ n = polynomial, and divisors that aren't 0, as they are given. *)
Definition polynomial (t : term) : option poly :=
  match normal [] [] [] t with Some f => Some (fst f) | None => None end.
Fixpoint rules_of (rs : list (term * term)) : option rules :=
  match rs with
  | [] => Some []
  | (a, b) :: rs =>
      match polynomial a, polynomial b, rules_of rs with
      | Some p, Some q, Some e =>
          match mon_of_pol 0%Q Qeq_bool p with Some m => Some ((m, q) :: e) | None => None end
      | _, _, _ => None
      end
  end.
Fixpoint divisors_of (e : rules) (ts : list term) : option (list poly) :=
  match ts with
  | [] => Some []
  | t :: ts =>
      match polynomial t, divisors_of e ts with Some d, Some ds => Some (reduce e d :: ds) | _, _ => None end
  end.
Fixpoint equations (l : list R) (rs : list (term * term)) : Prop :=
  match rs with [] => True | (a, b) :: rs => eval l [] a = eval l [] b /\ equations l rs end.
Fixpoint not_zero (l : list R) (ts : list term) : Prop :=
  match ts with [] => True | t :: ts => eval l [] t <> 0 /\ not_zero l ts end.
Fixpoint all_zero (l mids : list R) (ts : list term) : Prop :=
  match ts with
  | [] => True
  | t :: ts => match ts with [] => eval l mids t = 0 | _ => eval l mids t = 0 /\ all_zero l mids ts end
  end.
Definition decide rs ts defs goals : bool :=
  match rules_of rs with
  | Some e => match divisors_of e ts with Some ds => vanish e ds defs goals | None => false end
  | None => false
  end.

Lemma polynomial_is l t p : polynomial t = Some p -> eval l [] t = value_at l p.
Proof.
  unfold polynomial. destruct (normal [] [] [] t) as [f|] eqn:N; try discriminate. injection 1 as <-.
  rewrite (normal_is [] [] l I (Forall_nil _) [] []) with (f := f); try assumption.
  - unfold at_. destruct f as [p z]. simpl. ring.
  - intros [|k] f'; discriminate.
Qed.
Lemma rules_of_is l rs : forall e, rules_of rs = Some e -> equations l rs -> true_at l e.
Proof.
  induction rs as [|[a b] rs IH]; intros e; cbn [rules_of].
  - injection 1 as <-. intro. exact I.
  - destruct (polynomial a) as [p|] eqn:A; try discriminate. destruct (polynomial b) as [q|] eqn:B; try discriminate.
    destruct (rules_of rs) as [e'|]; try discriminate. destruct (mon_of_pol _ _ p) as [m|] eqn:M; try discriminate.
    injection 1 as <-. intros [E H]. split; [|apply IH; auto].
    rewrite (polynomial_is l _ _ A), (polynomial_is l _ _ B) in E. cbn [fst snd]. unfold value_at in E. rewrite <- E.
    apply (mon_of_pol_ok (Eqsth R) r_ext r_ring q_morph). assumption.
Qed.
Lemma divisors_of_is l e ts : true_at l e -> forall ds, divisors_of e ts = Some ds -> not_zero l ts -> none_is_0 l ds.
Proof.
  intro T. induction ts as [|t ts IH]; intros ds; cbn [divisors_of].
  - injection 1 as <-. constructor.
  - destruct (polynomial t) as [d|] eqn:D; try discriminate. destruct (divisors_of e ts) as [ds'|]; try discriminate.
    injection 1 as <-. intros [N H]. constructor; [|apply IH; auto].
    rewrite reduce_is, <- (polynomial_is l _ _ D) by assumption. assumption.
Qed.
Lemma vanishing l mids rs ts defs goals : equations l rs -> not_zero l ts -> holds l mids 0 defs ->
  decide rs ts defs goals = true -> all_zero l mids goals.
Proof.
  unfold decide. intros E N H. destruct (rules_of rs) as [e|] eqn:R; try discriminate.
  destruct (divisors_of e ts) as [ds|] eqn:D; try discriminate. intro V.
  apply rules_of_is with (l := l) in R; try assumption. apply divisors_of_is with (l := l) in D; try assumption.
  apply (vanish_is e ds l R D mids) in V; try assumption.
  induction V as [|t ts' Z V IH]; [exact I|]. destruct ts'; [exact Z | split; [exact Z | exact IH]].
Qed.

(* Terms from formulas, by their shape. *)
Ltac of_variables l k :=
  lazymatch l with
  | nil => constr:(@nil (R * term))
  | ?x :: ?xs => let j := eval compute in (Pos.succ k) in let r := of_variables xs j in constr:((x, Var k) :: r)
  end.
Ltac of_names mids k t :=
  lazymatch mids with nil => t | ?x :: ?xs => let r := of_names xs (S k) t in constr:((x, Mid k) :: r) end.
Ltac place x t := lazymatch t with (x, ?a) :: _ => a | _ :: ?r => place x r end.
Ltac quote t e :=
  lazymatch e with
  | IZR ?z => constr:(Num z)
  | ?a + ?b => let a := quote t a in let b := quote t b in constr:(Add a b)
  | ?a - ?b => let a := quote t a in let b := quote t b in constr:(Add a (Opp b))
  | ?a * ?b => let a := quote t a in let b := quote t b in constr:(Mul a b)
  | ?a / ?b => let a := quote t a in let b := quote t b in constr:(Mul a (Inv b))
  | - ?a => let a := quote t a in constr:(Opp a)
  | / ?a => let a := quote t a in constr:(Inv a)
  | ?a ^ ?n => let a := quote t a in constr:(Pow a n)
  | _ => place e t
  end.
Ltac quote_equations t ps :=
  lazymatch ps with
  | tt => constr:(@nil (term * term))
  | (?p, ?r) => lazymatch type of p with
      ?a = ?b => let a := quote t a in let b := quote t b in let r := quote_equations t r in constr:((a, b) :: r) end
  end.
Ltac quote_divisors t ps :=
  lazymatch ps with
  | tt => constr:(@nil term)
  | (?p, ?r) => lazymatch type of p with
      ?a <> 0 => let a := quote t a in let r := quote_divisors t r in constr:(a :: r) end
  end.
Ltac quote_definitions t names products :=
  lazymatch names with
  | nil => constr:(@nil (term * list Z))
  | ?u :: ?us => lazymatch products with ?z :: ?zs => match goal with
      _ : u = ?b |- _ =>
        let b := quote t b in let r := quote_definitions t us zs in constr:((b, z) :: r) end end
  end.
Ltac quote_goals t claim :=
  lazymatch claim with
  | ?a = 0 => let a := quote t a in constr:([a])
  | ?a = 0 /\ ?r => let a := quote t a in let r := quote_goals t r in constr:(a :: r)
  end.
Ltac given ps := lazymatch ps with tt => constr:(I) | (?p, ?r) => let r := given r in constr:(conj p r) end.
Ltac defined names :=
  lazymatch names with
  | nil => constr:(I)
  | ?u :: ?us => let r := defined us in match goal with H : u = _ |- _ => constr:(conj H r) end
  end.
Ltac all_vanish l mids relations divisors products :=
  lazymatch goal with |- ?claim =>
    let t := of_variables l 1%positive in
    let rs := quote_equations t relations in let ts := quote_divisors t divisors in
    let t := of_names mids O t in
    let defs := quote_definitions t mids products in let goals := quote_goals t claim in
    let e := given relations in let n := given divisors in let d := defined mids in
    exact_no_check (vanishing l mids rs ts defs goals e n d (@eq_refl bool true <: decide rs ts defs goals = true))
  end.
