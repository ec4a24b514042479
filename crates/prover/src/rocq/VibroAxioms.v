(* The kernel's axioms (crates/kernel/src/axioms.txt) as theorems about Rocq's real and complex numbers, with a tactic for signs of
   closed terms and rules of differentiation. *)

Require Import Reals Lra Lia.
Require Import Coquelicot.Coquelicot.
Require Interval.Tactic.
Require Import Interval.Float.Specific_stdz Interval.Float.Specific_ops.
Open Scope R_scope.

(* The words of the table. *)

Definition integer (x : R) : Prop := exists z : Z, x = IZR z.

Definition root (n : nat) (x : R) : R :=
  match n with
  | 2%nat => sqrt x
  | _ =>
    if Rlt_dec 0 x then Rpower x (/ INR n)
    else if Rlt_dec x 0 then - Rpower (- x) (/ INR n)
    else 0
  end.

Definition rpow (x y : R) : R :=
  if Rlt_dec 0 x then Rpower x y
  else if Req_EM_T y (IZR (Int_part y)) then powerRZ x (Int_part y)
  else 0.

(* Powers by cases of their exponent and base. *)

Lemma Int_part_IZR : forall z : Z, Int_part (IZR z) = z.
Proof.
  intro z. destruct (base_Int_part (IZR z)) as [H1 H2].
  apply le_IZR in H1.
  assert (H3 : IZR (z - 1) < IZR (Int_part (IZR z))) by (rewrite minus_IZR; lra).
  apply lt_IZR in H3. lia.
Qed.

Lemma rpow_IZR : forall (x : R) (z : Z), rpow x (IZR z) = powerRZ x z.
Proof.
  intros x z. unfold rpow. rewrite Int_part_IZR.
  destruct (Rlt_dec 0 x) as [H | H].
  - now rewrite powerRZ_Rpower.
  - destruct (Req_EM_T (IZR z) (IZR z)) as [_ | F]; [reflexivity | now elim F].
Qed.

Lemma rpow_INR : forall (x : R) (n : nat), rpow x (INR n) = x ^ n.
Proof. intros x n. now rewrite INR_IZR_INZ, rpow_IZR, pow_powerRZ. Qed.

Lemma rpow_pos : forall x y : R, 0 < x -> rpow x y = exp (y * ln x).
Proof. intros x y H. unfold rpow. destruct (Rlt_dec 0 x); [reflexivity | contradiction]. Qed.

Lemma rpow_Rpower : forall x y : R, 0 < x -> rpow x y = Rpower x y.
Proof. exact rpow_pos. Qed.

Lemma powerRZ_nonneg_add : forall (x : R) (a b : Z), (0 <= a)%Z -> (0 <= b)%Z ->
  powerRZ x (a + b) = powerRZ x a * powerRZ x b.
Proof.
  intros x a b Ha Hb.
  rewrite <- (Z2Nat.id a Ha), <- (Z2Nat.id b Hb), <- Nat2Z.inj_add, <- !pow_powerRZ.
  apply pow_add.
Qed.

Lemma powerRZ_powerRZ : forall (x : R) (a b : Z), powerRZ (powerRZ x a) b = powerRZ x (a * b).
Proof.
  assert (N : forall (x : R) (n m : nat),
    powerRZ (powerRZ x (Z.of_nat n)) (Z.of_nat m) = powerRZ x (Z.of_nat n * Z.of_nat m)).
  { intros x n m. rewrite <- Nat2Z.inj_mul, <- !pow_powerRZ. symmetry. apply pow_mult. }
  intros x a b.
  destruct (Z_le_gt_dec 0 a) as [Ha | Ha]; destruct (Z_le_gt_dec 0 b) as [Hb | Hb].
  - rewrite <- (Z2Nat.id a Ha), <- (Z2Nat.id b Hb). apply N.
  - replace b with (- Z.of_nat (Z.to_nat (- b)))%Z by lia.
    rewrite <- (Z2Nat.id a Ha), Z.mul_opp_r, !powerRZ_neg', N. reflexivity.
  - replace a with (- Z.of_nat (Z.to_nat (- a)))%Z by lia.
    rewrite <- (Z2Nat.id b Hb), Z.mul_opp_l, !powerRZ_neg', powerRZ_inv', N. reflexivity.
  - replace a with (- Z.of_nat (Z.to_nat (- a)))%Z by lia.
    replace b with (- Z.of_nat (Z.to_nat (- b)))%Z by lia.
    rewrite Z.mul_opp_opp, !powerRZ_neg', powerRZ_inv', Rinv_inv, N. reflexivity.
Qed.

(* Roots by cases of their radicand. *)

Lemma INR_pos : forall n : nat, (1 <= n)%nat -> 0 < INR n.
Proof. intros n H. apply lt_0_INR. lia. Qed.

Lemma root_Rpower : forall (n : nat) (x : R), 0 < x -> root n x = Rpower x (/ INR n).
Proof.
  intros n x H.
  destruct n as [| [| [| n]]]; unfold root;
    try (destruct (Rlt_dec 0 x); [reflexivity | contradiction]).
  symmetry. replace (INR 2) with 2 by (simpl; ring). now apply Rpower_sqrt.
Qed.

Lemma root_pos : forall (n : nat) (x : R), 0 < x -> root n x = exp (ln x / INR n).
Proof.
  intros n x H. rewrite root_Rpower by assumption. unfold Rpower. f_equal.
  unfold Rdiv. ring.
Qed.

Lemma root_0 : forall n : nat, root n 0 = 0.
Proof.
  intros n. destruct n as [| [| [| n]]]; unfold root;
    try (destruct (Rlt_dec 0 0); [lra | reflexivity]).
  apply sqrt_0.
Qed.

Lemma root_zero : forall (n : nat) (x : R), x = 0 -> root n x = 0.
Proof. intros n x ->. apply root_0. Qed.

Lemma root_opp : forall (n : nat) (x : R), Nat.odd n = true -> x < 0 -> root n x = - root n (- x).
Proof.
  intros n x O H.
  destruct n as [| [| [| n]]]; unfold root; try discriminate O;
    (destruct (Rlt_dec 0 x); [lra |]; destruct (Rlt_dec x 0); [| lra];
     destruct (Rlt_dec 0 (- x)); [reflexivity | lra]).
Qed.

Lemma root_neg : forall (n : nat) (x : R), Nat.odd n = true -> x < 0 -> root n x = - exp (ln (- x) / INR n).
Proof. intros n x O H. rewrite root_opp by assumption. rewrite root_pos by lra. reflexivity. Qed.

Lemma root_gt_0 : forall (n : nat) (x : R), 0 < x -> 0 < root n x.
Proof. intros n x H. rewrite root_pos by assumption. apply exp_pos. Qed.

Lemma root_ge_0 : forall (n : nat) (x : R), 0 <= x -> 0 <= root n x.
Proof.
  intros n x [H | <-]; [left; now apply root_gt_0 | rewrite root_0; lra].
Qed.

Lemma root_pow : forall (n : nat) (x : R), (1 <= n)%nat -> 0 <= x -> root n x ^ n = x.
Proof.
  intros n x N [H | <-].
  - rewrite root_Rpower by assumption.
    rewrite <- Rpower_pow by apply exp_pos.
    rewrite Rpower_mult, Rinv_l; [now apply Rpower_1 |].
    apply Rgt_not_eq. now apply INR_pos.
  - rewrite root_0. apply pow_i. lia.
Qed.

Lemma pow_opp_odd : forall (n : nat) (x : R), Nat.odd n = true -> (- x) ^ n = - x ^ n.
Proof.
  intros n x O. apply Nat.odd_spec in O. destruct O as [k ->].
  rewrite !pow_add, !pow_mult. replace ((- x) ^ 2) with (x ^ 2) by ring. ring.
Qed.

Lemma pow_0_eq : forall (n : nat) (x : R), x ^ n = 0 -> x = 0.
Proof.
  intros n x H. destruct (Req_dec x 0) as [E | E]; [exact E | elim (pow_nonzero x n E H)].
Qed.

(* Sines and cosines. *)

Lemma Pythagoras : forall x : R, sin x ^ 2 + cos x ^ 2 = 1.
Proof. intro x. generalize (sin2_cos2 x). unfold Rsqr. intros. ring_simplify. lra. Qed.

Lemma SineOfSum : forall s a b : R, s = a + b -> sin s = sin a * cos b + cos a * sin b.
Proof. intros s a b ->. apply sin_plus. Qed.

Lemma CosineOfSum : forall s a b : R, s = a + b -> cos s = cos a * cos b - sin a * sin b.
Proof. intros s a b ->. apply cos_plus. Qed.

Lemma SineOfNegative : forall s a : R, s = - a -> sin s = - sin a.
Proof. intros s a ->. apply sin_neg. Qed.

Lemma CosineOfNegative : forall s a : R, s = - a -> cos s = cos a.
Proof. intros s a ->. apply cos_neg. Qed.

Lemma SineOfZero : forall s : R, s = 0 -> sin s = 0.
Proof. intros s ->. apply sin_0. Qed.

Lemma CosineOfZero : forall s : R, s = 0 -> cos s = 1.
Proof. intros s ->. apply cos_0. Qed.

Lemma SineOfPi : sin PI = 0.
Proof. exact sin_PI. Qed.

Lemma CosineOfPi : cos PI = -1.
Proof. exact cos_PI. Qed.

Lemma SineOfHalfTurns : forall n : R, integer n -> sin (PI * n) = 0.
Proof. intros n [z ->]. apply sin_eq_0_1. exists z. ring. Qed.

Lemma cos_PI_INR : forall n : nat, cos (PI * INR n) = (-1) ^ n.
Proof.
  induction n as [| n IH].
  - simpl. rewrite Rmult_0_r. apply cos_0.
  - rewrite S_INR, Rmult_plus_distr_l, Rmult_1_r, neg_cos, IH. simpl. ring.
Qed.

Lemma CosineOfHalfTurns : forall n : R, integer n -> cos (PI * n) = rpow (-1) n.
Proof.
  intros n [z ->]. rewrite rpow_IZR.
  destruct (Z_le_gt_dec 0 z) as [H | H].
  - rewrite <- (Z2Nat.id z H), <- INR_IZR_INZ, <- pow_powerRZ. apply cos_PI_INR.
  - replace z with (- Z.of_nat (Z.to_nat (- z)))%Z by lia.
    rewrite powerRZ_neg', opp_IZR, Ropp_mult_distr_r_reverse, cos_neg, <- INR_IZR_INZ, <- pow_powerRZ, cos_PI_INR.
    rewrite <- pow_inv. f_equal. lra.
Qed.

Lemma CosineOfTurns : forall n : R, integer n -> cos (2 * PI * n) = 1.
Proof.
  intros n I. replace (2 * PI * n) with (2 * (PI * n)) by ring.
  rewrite cos_2a_sin, SineOfHalfTurns by assumption. ring.
Qed.

Lemma SinePositive : forall x : R, x > 0 -> PI - x > 0 -> sin x > 0.
Proof. intros x H1 H2. apply sin_gt_0; lra. Qed.

Lemma AngleUnique : forall a b : R, sin a = sin b -> cos a = cos b ->
  2 * PI - (a - b) > 0 -> 2 * PI + (a - b) > 0 -> a = b.
Proof.
  intros a b S C H1 H2.
  assert (D : cos (a - b) = 1).
  { rewrite cos_minus, S, C. generalize (sin2_cos2 b). unfold Rsqr. lra. }
  assert (Z : sin ((a - b) / 2) = 0).
  { replace (a - b) with (2 * ((a - b) / 2)) in D by field. rewrite cos_2a_sin in D. nra. }
  destruct (Rtotal_order (a - b) 0) as [L | [E | G]].
  - generalize (sin_gt_0 (- ((a - b) / 2))). rewrite sin_neg. lra.
  - lra.
  - generalize (sin_gt_0 ((a - b) / 2)). lra.
Qed.

(* Exponential function and logarithm. *)

Lemma ExpOfSum : forall s a b : R, s = a + b -> exp s = exp a * exp b.
Proof. intros s a b ->. apply exp_plus. Qed.

Lemma ExpOfZero : forall s : R, s = 0 -> exp s = 1.
Proof. intros s ->. apply exp_0. Qed.

Lemma ExpPositive : forall x : R, exp x > 0.
Proof. exact exp_pos. Qed.

Lemma ExpNonzero : forall x : R, exp x <> 0.
Proof. intro x. apply Rgt_not_eq, exp_pos. Qed.

Lemma ExpInjective : forall a b : R, exp a = exp b -> a = b.
Proof. exact exp_inv. Qed.

Lemma ExpOfLn : forall x : R, x > 0 -> exp (ln x) = x.
Proof. exact exp_ln. Qed.

Lemma LnOfExp : forall x : R, ln (exp x) = x.
Proof. exact ln_exp. Qed.

(* Roots. *)

Lemma RootPower : forall (n : nat) (x : R), (2 <= n)%nat -> (Nat.even n = true -> x >= 0) -> root n x ^ n = x.
Proof.
  intros n x N E. destruct (Rle_dec 0 x) as [H | H].
  - apply root_pow; [lia | exact H].
  - assert (O : Nat.odd n = true).
    { rewrite <- Nat.negb_even. destruct (Nat.even n); [| reflexivity]. specialize (E eq_refl). lra. }
    rewrite root_opp, pow_opp_odd, root_pow; try assumption; try lra. lia.
Qed.

Lemma RootNonNegative : forall (n : nat) (x : R), (2 <= n)%nat -> Nat.even n = true ->
  (Nat.even n = true -> x >= 0) -> root n x >= 0.
Proof. intros n x _ E H. apply Rle_ge, root_ge_0, Rge_le, H, E. Qed.

Lemma RootUnique : forall (n : nat) (x y : R), (2 <= n)%nat -> y >= 0 -> y ^ n = x -> root n x = y.
Proof.
  intros n x y N Y <-. destruct Y as [Y | ->].
  - rewrite root_Rpower by now apply pow_lt.
    rewrite <- Rpower_pow, Rpower_mult, Rinv_r; [now apply Rpower_1 | | assumption].
    apply Rgt_not_eq, INR_pos. lia.
  - rewrite pow_i by lia. apply root_0.
Qed.

Lemma OddRootUnique : forall (n : nat) (x y : R), (2 <= n)%nat -> Nat.odd n = true -> y ^ n = x -> root n x = y.
Proof.
  intros n x y N O E. destruct (Rle_dec 0 y) as [H | H].
  - apply RootUnique; [exact N | lra | exact E].
  - assert (P : 0 < (- y) ^ n) by (apply pow_lt; lra).
    rewrite pow_opp_odd, E in P by assumption.
    rewrite root_opp, (RootUnique n (- x) (- y)); try assumption; try lra.
    rewrite pow_opp_odd by assumption. lra.
Qed.

(* Powers. *)

Lemma RealPower : forall x y : R, x > 0 -> rpow x y = exp (y * ln x).
Proof. exact rpow_pos. Qed.

Lemma IntegerPower : forall (x p : R) (n : nat), p = INR n -> rpow x p = x ^ n.
Proof. intros x p n ->. apply rpow_INR. Qed.

Lemma NegativePower : forall (x p : R) (n : nat), p = - INR n -> x <> 0 -> rpow x p = 1 / x ^ n.
Proof.
  intros x p n -> X. rewrite INR_IZR_INZ, <- opp_IZR, rpow_IZR, powerRZ_neg', <- pow_powerRZ.
  unfold Rdiv. ring.
Qed.

Lemma PowerOfSum : forall x s a b : R, s = a + b -> integer a -> integer b -> a >= 0 -> b >= 0 ->
  rpow x s = rpow x a * rpow x b.
Proof.
  intros x s a b -> [n ->] [m ->] N M. rewrite <- plus_IZR, !rpow_IZR.
  apply powerRZ_nonneg_add; apply le_IZR; lra.
Qed.

Lemma NonzeroPowerOfSum : forall x s a b : R, s = a + b -> integer a -> integer b -> x <> 0 ->
  rpow x s = rpow x a * rpow x b.
Proof.
  intros x s a b -> [n ->] [m ->] X. rewrite <- plus_IZR, !rpow_IZR. now apply powerRZ_add.
Qed.

Lemma PowerOfProduct : forall p a b n : R, p = a * b -> integer n -> n >= 0 -> rpow p n = rpow a n * rpow b n.
Proof. intros p a b n -> [z ->] _. rewrite !rpow_IZR. apply powerRZ_mult. Qed.

Lemma NonzeroPowerOfProduct : forall p a b n : R, p = a * b -> integer n -> a <> 0 -> b <> 0 ->
  rpow p n = rpow a n * rpow b n.
Proof. intros p a b n -> [z ->] _ _. rewrite !rpow_IZR. apply powerRZ_mult. Qed.

Lemma PowerOfPower : forall x p n m : R, p = n * m -> integer n -> integer m -> x <> 0 ->
  rpow (rpow x n) m = rpow x p.
Proof.
  intros x p n m -> [a ->] [b ->] _. rewrite <- mult_IZR, !rpow_IZR. apply powerRZ_powerRZ.
Qed.

Lemma PowerNonzero : forall x n : R, x <> 0 -> integer n -> rpow x n <> 0.
Proof. intros x n X [z ->]. rewrite rpow_IZR. now apply powerRZ_NOR. Qed.

Lemma PowerOfOne : forall x y : R, x = 1 -> rpow x y = 1.
Proof. intros x y ->. rewrite rpow_pos by lra. rewrite ln_1, Rmult_0_r. apply exp_0. Qed.

Lemma IntegerAtLeastOne : forall n : R, integer n -> n > 0 -> n >= 1.
Proof. intros n [z ->] H. apply lt_IZR in H. apply IZR_ge. lia. Qed.

(* Inverse functions of sines, cosines and tangents. *)

Lemma SineOfArcsin : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> sin (asin x) = x.
Proof. intros x H1 H2. apply sin_asin. lra. Qed.

Lemma CosineOfArccos : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> cos (acos x) = x.
Proof. intros x H1 H2. apply cos_acos. lra. Qed.

Lemma CosineOfArctan : forall x : R, cos (atan x) > 0.
Proof. intro x. destruct (atan_bound x) as [H1 H2]. apply cos_gt_0; lra. Qed.

Lemma SineOfArctan : forall x : R, sin (atan x) = x * cos (atan x).
Proof.
  intro x. generalize (CosineOfArctan x). intro C.
  rewrite <- (tan_atan x) at 2. unfold tan. field. lra.
Qed.

Lemma CosineOfArcsin : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> cos (asin x) >= 0.
Proof. intros x _ _. destruct (asin_bound x) as [H1 H2]. apply Rle_ge, cos_ge_0; lra. Qed.

Lemma SineOfArccos : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> sin (acos x) >= 0.
Proof. intros x _ _. destruct (acos_bound x) as [H1 H2]. apply Rle_ge, sin_ge_0; lra. Qed.

Lemma ArcsinAbove : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> asin x + PI / 2 >= 0.
Proof. intros x _ _. destruct (asin_bound x). lra. Qed.

Lemma ArcsinBelow : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> PI / 2 - asin x >= 0.
Proof. intros x _ _. destruct (asin_bound x). lra. Qed.

Lemma ArccosAbove : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> acos x >= 0.
Proof. intros x _ _. destruct (acos_bound x). lra. Qed.

Lemma ArccosBelow : forall x : R, 1 - x >= 0 -> 1 + x >= 0 -> PI - acos x >= 0.
Proof. intros x _ _. destruct (acos_bound x). lra. Qed.

Lemma ArctanOfZero : forall x : R, x = 0 -> atan x = 0.
Proof. intros x ->. exact atan_0. Qed.

Lemma ArctanAbove : forall x : R, atan x + PI / 2 > 0.
Proof. intro x. destruct (atan_bound x). lra. Qed.

Lemma ArctanBelow : forall x : R, PI / 2 - atan x > 0.
Proof. intro x. destruct (atan_bound x). lra. Qed.

(* Signs of closed terms, by interval arithmetic over integers of unbounded size, which needs no axiom about machine integers. *)

Module ZFloat := SpecificFloat StdZRadix2.
Module ZTactic := Interval.Tactic.IntervalTactic ZFloat.
Import ZTactic.

Ltac enclose_plain := interval with (Interval.Tactic.i_prec 100).
Ltac enclose_finer := interval with (Interval.Tactic.i_prec 400).

Lemma asin_inside : forall x : R, -1 < x < 1 -> asin x = atan (x / sqrt (1 - x * x)).
Proof. exact asin_atan. Qed.

Lemma asin_one : forall x : R, x = 1 -> asin x = PI / 2.
Proof. intros x ->. apply asin_1. Qed.

Lemma asin_minus_one : forall x : R, x = -1 -> asin x = - (PI / 2).
Proof. intros x ->. replace (-1) with (- (1)) by lra. now rewrite asin_opp, asin_1. Qed.

Lemma acos_as_asin : forall x : R, acos x = PI / 2 - asin x.
Proof.
  intro x. unfold acos, asin.
  destruct (Rle_dec x (-1)); destruct (Rle_dec 1 x); try lra.
Qed.

Lemma rpow_zero : forall x y : R, x = 0 -> 0 < y -> rpow x y = 0.
Proof.
  intros x y -> Y. unfold rpow. destruct (Rlt_dec 0 0) as [F | _]; [lra |].
  destruct (Req_EM_T y (IZR (Int_part y))) as [E | _]; [| reflexivity].
  rewrite E in Y. apply lt_IZR in Y.
  rewrite <- (Z2Nat.id (Int_part y)) by lia. rewrite <- pow_powerRZ. apply pow_i. lia.
Qed.

Lemma rpow_opp_IZR : forall (x : R) (z : Z), rpow x (- IZR z) = powerRZ x (- z).
Proof. intros x z. rewrite <- opp_IZR. apply rpow_IZR. Qed.

(* Written-out natural numbers become integers that interval arithmetic and ring normalisation read. *)
Ltac numerals :=
  repeat match goal with
  | |- context [INR ?n] =>
    let z := eval compute in (Z.of_nat n) in
    lazymatch z with
    | Z0 => idtac
    | Zpos _ => idtac
    end;
    rewrite (INR_IZR_INZ n); change (Z.of_nat n) with z
  end.

Ltac known x :=
  lazymatch x with
  | context [root _ _] => fail
  | context [rpow _ _] => fail
  | context [asin _] => fail
  | context [acos _] => fail
  | _ => idtac
  end.

Ltac closed_zero := first [lra | field; lra].

Ltac enclose_root n x :=
  lazymatch n with
  | 2%nat => change (root n x) with (sqrt x)
  | _ =>
    let H := fresh in
    first
    [ assert (H : 0 < x) by enclose_plain; rewrite (root_pos n x H); clear H
    | assert (H : x < 0) by enclose_plain; rewrite (root_neg n x (eq_refl true) H); clear H
    | assert (H : x = 0) by closed_zero; rewrite (root_zero n x H); clear H ]
  end.

Ltac enclose_rpow x y :=
  lazymatch y with
  | IZR ?z => rewrite (rpow_IZR x z)
  | INR ?n => rewrite (rpow_INR x n)
  | - IZR ?z => rewrite (rpow_opp_IZR x z); let w := eval compute in (- z)%Z in change (- z)%Z with w
  | _ =>
    let H := fresh in
    let K := fresh in
    first
    [ assert (H : 0 < x) by enclose_plain; rewrite (rpow_pos x y H); clear H
    | assert (H : x = 0) by closed_zero; assert (K : 0 < y) by enclose_plain; rewrite (rpow_zero x y H K); clear H K ]
  end.

Ltac enclose_asin x :=
  let H := fresh in
  first
  [ assert (H : -1 < x < 1) by (split; enclose_plain); rewrite (asin_inside x H); clear H
  | assert (H : x = 1) by closed_zero; rewrite (asin_one x H); clear H
  | assert (H : x = -1) by closed_zero; rewrite (asin_minus_one x H); clear H ].

Ltac enclose_step :=
  match goal with
  | |- context [root ?n ?x] => known x; enclose_root n x
  | |- context [rpow ?x ?y] => known x; known y; enclose_rpow x y
  | |- context [acos ?x] => known x; rewrite (acos_as_asin x)
  | |- context [asin ?x] => known x; enclose_asin x
  end.

Ltac enclose :=
  numerals; repeat (enclose_step; numerals);
  first [enclose_plain | enclose_finer | lra].

(* The same wherever a letter lies between its bounds. *)
Ltac enclose_on x :=
  first
    [ interval with (Interval.Tactic.i_prec 60, Interval.Tactic.i_bisect x)
    | interval with (Interval.Tactic.i_prec 60, Interval.Tactic.i_bisect x, Interval.Tactic.i_depth 25)
    | interval with (Interval.Tactic.i_prec 100, Interval.Tactic.i_taylor x, Interval.Tactic.i_depth 20)
    | repeat match goal with
        | |- context [asin ?t] => generalize (asin t) (asin_bound t); intros
        | |- context [acos ?t] => generalize (acos t) (acos_bound t); intros
        | |- context [atan ?t] => generalize (atan t) (atan_bound t); intros
      end;
      generalize PI_RGT_0; intro; lra ].

Example enclose_1 : 0 < root 3 2 - 5 / 4.
Proof. enclose. Qed.
Example enclose_2 : root 3 (-2) + 13 / 10 > 0.
Proof. enclose. Qed.
Example enclose_3 : rpow 2 (sqrt 2) - rpow (1 / 3) PI >= 0.
Proof. enclose. Qed.
Example enclose_4 : asin (1 / 2) - PI / 7 <> 0.
Proof. enclose. Qed.
Example enclose_5 : 0 < acos (root 5 (rpow 2 (-3))) + rpow (-2) 3 + 9.
Proof. enclose. Qed.
Example enclose_6 : 0 < asin 1 + acos (-1) + asin (2 / 2) + asin (- (1)) - 4.
Proof. enclose. Qed.
Example enclose_7 : 1 + root 2 2 - exp (ln 2 / 3) + atan (sin 1 * cos 2) >= 0.
Proof. enclose. Qed.
Example enclose_8 : rpow 2 (INR 5) - rpow 3 (- (2)) - root 4 0 - rpow 0 (1 / 2) - 31 > 0.
Proof. enclose. Qed.
Example enclose_9 : 640320 ^ 3 + 744 - exp (PI * root 2 163) > 0.
Proof. enclose. Qed.
Example enclose_10 : 1 / 3 - 1 / 3 >= 0.
Proof. enclose. Qed.

(* Derivatives: a rule for each operation, to be applied one node at a time. *)

Lemma D_equal : forall (f : R -> R) (x l m : R), is_derive f x l -> l = m -> is_derive f x m.
Proof. intros f x l m H <-. exact H. Qed.

Lemma D_near : forall (f g : R -> R) (x l : R), locally x (fun t => f t = g t) -> is_derive f x l -> is_derive g x l.
Proof. intros f g x l E H. exact (is_derive_ext_loc f g x l E H). Qed.

Lemma D_chain : forall (F f : R -> R) (x l m : R), is_derive F (f x) m -> is_derive f x l ->
  is_derive (fun t => F (f t)) x (m * l).
Proof.
  intros F f x l m HF Hf. eapply D_equal; [exact (is_derive_comp F f x m l HF Hf) |]. apply Rmult_comm.
Qed.

Lemma D_const : forall c x : R, is_derive (fun _ : R => c) x 0.
Proof. intros c x. exact (is_derive_const c x). Qed.

Lemma D_id : forall x : R, is_derive (fun t : R => t) x 1.
Proof. intro x. exact (is_derive_id x). Qed.

Lemma D_plus : forall (f g : R -> R) (x l m : R), is_derive f x l -> is_derive g x m ->
  is_derive (fun t => f t + g t) x (l + m).
Proof. intros f g x l m F G. exact (is_derive_plus f g x l m F G). Qed.

Lemma D_minus : forall (f g : R -> R) (x l m : R), is_derive f x l -> is_derive g x m ->
  is_derive (fun t => f t - g t) x (l - m).
Proof. intros f g x l m F G. exact (is_derive_minus f g x l m F G). Qed.

Lemma D_opp : forall (f : R -> R) (x l : R), is_derive f x l -> is_derive (fun t => - f t) x (- l).
Proof. intros f x l F. exact (is_derive_opp f x l F). Qed.

Lemma D_mult : forall (f g : R -> R) (x l m : R), is_derive f x l -> is_derive g x m ->
  is_derive (fun t => f t * g t) x (l * g x + f x * m).
Proof. intros f g x l m F G. exact (is_derive_mult f g x l m F G Rmult_comm). Qed.

Lemma D_scal : forall (c : R) (f : R -> R) (x l : R), is_derive f x l -> is_derive (fun t => c * f t) x (c * l).
Proof. intros c f x l F. exact (is_derive_scal f x c l F). Qed.

Lemma D_scal_r : forall (c : R) (f : R -> R) (x l : R), is_derive f x l -> is_derive (fun t => f t * c) x (l * c).
Proof.
  intros c f x l F. eapply D_equal; [exact (D_mult f (fun _ => c) x l 0 F (D_const c x)) | cbv beta; ring].
Qed.

Lemma D_div_const : forall (c : R) (f : R -> R) (x l : R), is_derive f x l -> is_derive (fun t => f t / c) x (l / c).
Proof. intros c f x l F. exact (D_scal_r (/ c) f x l F). Qed.

Lemma D_inv : forall (f : R -> R) (x l : R), is_derive f x l -> f x <> 0 -> is_derive (fun t => / f t) x (- l / f x ^ 2).
Proof. exact is_derive_inv. Qed.

Lemma D_div : forall (f g : R -> R) (x l m : R), is_derive f x l -> is_derive g x m -> g x <> 0 ->
  is_derive (fun t => f t / g t) x ((l * g x - f x * m) / g x ^ 2).
Proof. exact is_derive_div. Qed.

Lemma D_pow : forall (f : R -> R) (n : nat) (x l : R), is_derive f x l ->
  is_derive (fun t => f t ^ n) x (INR n * l * f x ^ Nat.pred n).
Proof. exact is_derive_pow. Qed.

Lemma D_powerRZ : forall (f : R -> R) (z : Z) (x l : R), is_derive f x l -> f x <> 0 ->
  is_derive (fun t => powerRZ (f t) z) x (IZR z * powerRZ (f x) (z - 1) * l).
Proof.
  intros f z x l F N.
  destruct (Z_le_gt_dec 0 z) as [H | H].
  - apply (is_derive_ext (fun t => f t ^ Z.to_nat z)).
    { intro t. now rewrite pow_powerRZ, Z2Nat.id. }
    eapply D_equal; [apply (D_pow f (Z.to_nat z) x l F) |].
    rewrite INR_IZR_INZ, Z2Nat.id by exact H.
    destruct (Z.eq_dec z 0) as [-> | Z]; [simpl; ring |].
    rewrite pow_powerRZ. replace (Z.of_nat (Nat.pred (Z.to_nat z))) with (z - 1)%Z by lia. ring.
  - apply (is_derive_ext (fun t => / f t ^ Z.to_nat (- z))).
    { intro t. rewrite pow_powerRZ, Z2Nat.id, powerRZ_neg', Rinv_inv by lia. reflexivity. }
    eapply D_equal; [apply D_inv; [apply (D_pow f (Z.to_nat (- z)) x l F) | now apply pow_nonzero] |].
    rewrite INR_IZR_INZ, Z2Nat.id, opp_IZR by lia.
    set (n := Nat.pred (Z.to_nat (- z))).
    replace (z - 1)%Z with (- Z.of_nat (2 + n))%Z by (unfold n; lia).
    replace (Z.to_nat (- z)) with (1 + n)%nat by (unfold n; lia).
    rewrite powerRZ_neg', <- pow_powerRZ, !pow_add. field.
    split; [now apply pow_nonzero | exact N].
Qed.

Lemma D_sin : forall (f : R -> R) (x l : R), is_derive f x l -> is_derive (fun t => sin (f t)) x (cos (f x) * l).
Proof. intros f x l F. exact (D_chain sin f x l _ (is_derive_sin (f x)) F). Qed.

Lemma D_cos : forall (f : R -> R) (x l : R), is_derive f x l -> is_derive (fun t => cos (f t)) x (- sin (f x) * l).
Proof. intros f x l F. exact (D_chain cos f x l _ (is_derive_cos (f x)) F). Qed.

Lemma D_tan : forall (f : R -> R) (x l : R), is_derive f x l -> cos (f x) <> 0 ->
  is_derive (fun t => tan (f t)) x (l / cos (f x) ^ 2).
Proof.
  intros f x l F N. eapply D_equal; [apply D_div; [apply D_sin, F | apply D_cos, F | exact N] |].
  generalize (Pythagoras (f x)). intro P.
  replace (cos (f x) * l * cos (f x) - sin (f x) * (- sin (f x) * l)) with (l * (sin (f x) ^ 2 + cos (f x) ^ 2)) by ring.
  now rewrite P, Rmult_1_r.
Qed.

Lemma D_exp : forall (f : R -> R) (x l : R), is_derive f x l -> is_derive (fun t => exp (f t)) x (exp (f x) * l).
Proof. intros f x l F. exact (D_chain exp f x l _ (is_derive_exp (f x)) F). Qed.

Lemma D_ln : forall (f : R -> R) (x l : R), is_derive f x l -> 0 < f x -> is_derive (fun t => ln (f t)) x (l / f x).
Proof.
  intros f x l F P. eapply D_equal; [exact (D_chain ln f x l _ (is_derive_ln (f x) P) F) |]. apply Rmult_comm.
Qed.

Lemma D_sqrt : forall (f : R -> R) (x l : R), is_derive f x l -> 0 < f x ->
  is_derive (fun t => sqrt (f t)) x (l / (2 * sqrt (f x))).
Proof. exact is_derive_sqrt. Qed.

Lemma D_Rabs : forall (f : R -> R) (x l : R), is_derive f x l -> f x <> 0 ->
  is_derive (fun t => Rabs (f t)) x (sign (f x) * l).
Proof. exact is_derive_Rabs. Qed.

Lemma D_atan : forall (f : R -> R) (x l : R), is_derive f x l -> is_derive (fun t => atan (f t)) x (l / (1 + f x ^ 2)).
Proof.
  intros f x l F. eapply D_equal; [exact (D_chain atan f x l _ (is_derive_atan (f x)) F) |].
  rewrite Rsqr_pow2. apply Rmult_comm.
Qed.

Lemma is_derive_asin : forall x : R, -1 < x < 1 -> is_derive asin x (/ sqrt (1 - x ^ 2)).
Proof.
  intros x H. apply is_derive_Reals.
  generalize (derive_pt_asin x H). intro E.
  apply derive_pt_eq_1 in E. rewrite Rsqr_pow2 in E.
  replace (/ sqrt (1 - x ^ 2)) with (1 / sqrt (1 - x ^ 2)) by (unfold Rdiv; ring). exact E.
Qed.

Lemma is_derive_acos : forall x : R, -1 < x < 1 -> is_derive acos x (- / sqrt (1 - x ^ 2)).
Proof.
  intros x H. apply (is_derive_ext (fun t => PI / 2 - asin t)).
  { intro t. symmetry. apply acos_as_asin. }
  eapply D_equal; [apply D_minus; [apply D_const | apply is_derive_asin, H] | cbv beta; ring].
Qed.

Lemma D_asin : forall (f : R -> R) (x l : R), is_derive f x l -> -1 < f x < 1 ->
  is_derive (fun t => asin (f t)) x (l / sqrt (1 - f x ^ 2)).
Proof.
  intros f x l F H. eapply D_equal; [exact (D_chain asin f x l _ (is_derive_asin (f x) H) F) |]. apply Rmult_comm.
Qed.

Lemma D_acos : forall (f : R -> R) (x l : R), is_derive f x l -> -1 < f x < 1 ->
  is_derive (fun t => acos (f t)) x (- l / sqrt (1 - f x ^ 2)).
Proof.
  intros f x l F H. eapply D_equal; [exact (D_chain acos f x l _ (is_derive_acos (f x) H) F) |].
  unfold Rdiv. ring.
Qed.

(* Near a point where a function has a derivative and is positive it stays positive. *)
Lemma near_positive : forall (f : R -> R) (x l : R), is_derive f x l -> 0 < f x -> locally x (fun t => 0 < f t).
Proof.
  intros f x l F P.
  assert (C : continuous f x) by exact (ex_derive_continuous f x (ex_intro _ l F)).
  exact (C (fun y => 0 < y) (open_gt 0 (f x) P)).
Qed.

Lemma D_root : forall (n : nat) (f : R -> R) (x l : R), is_derive f x l -> (1 <= n)%nat -> 0 < f x ->
  is_derive (fun t => root n (f t)) x (root n (f x) * l / (INR n * f x)).
Proof.
  intros n f x l F N P.
  apply (D_near (fun t => exp (ln (f t) / INR n))).
  { generalize (near_positive f x l F P). apply filter_imp. intros t T. symmetry. now apply root_pos. }
  eapply D_equal; [apply D_exp, D_div_const, D_ln; [exact F | exact P] |].
  rewrite root_pos by exact P. field.
  split; [lra | apply Rgt_not_eq, INR_pos, N].
Qed.

Lemma D_root_odd : forall (n : nat) (f : R -> R) (x l : R), is_derive f x l -> Nat.odd n = true -> f x <> 0 ->
  is_derive (fun t => root n (f t)) x (root n (f x) * l / (INR n * f x)).
Proof.
  intros n f x l F O NZ.
  assert (N : (1 <= n)%nat) by (destruct n; [discriminate O | lia]).
  destruct (Rlt_dec 0 (f x)) as [P | P]; [now apply D_root |].
  assert (Q : 0 < - f x) by lra.
  apply (D_near (fun t => - root n (- f t))).
  { generalize (near_positive (fun t => - f t) x (- l) (D_opp f x l F) Q). apply filter_imp.
    intros t T. symmetry. apply root_opp; [exact O | lra]. }
  eapply D_equal; [apply D_opp, D_root; [apply D_opp, F | exact N | exact Q] |].
  rewrite (root_opp n (f x)) by (trivial; lra). field.
  split; [lra | apply Rgt_not_eq, INR_pos, N].
Qed.

Lemma D_rpow : forall (f g : R -> R) (x l m : R), is_derive f x l -> is_derive g x m -> 0 < f x ->
  is_derive (fun t => rpow (f t) (g t)) x (rpow (f x) (g x) * (m * ln (f x) + g x * l / f x)).
Proof.
  intros f g x l m F G P.
  apply (D_near (fun t => exp (g t * ln (f t)))).
  { generalize (near_positive f x l F P). apply filter_imp. intros t T. symmetry. now apply rpow_pos. }
  eapply D_equal; [apply D_exp, D_mult; [exact G | apply D_ln; [exact F | exact P]] |].
  rewrite rpow_pos by exact P. field. lra.
Qed.

Lemma D_rpow_const : forall (c : R) (f : R -> R) (x l : R), is_derive f x l -> 0 < f x ->
  is_derive (fun t => rpow (f t) c) x (rpow (f x) c * (c * l / f x)).
Proof.
  intros c f x l F P.
  eapply D_equal; [apply (D_rpow f (fun _ => c) x l 0 F (D_const c x) P) | cbv beta; ring].
Qed.

Lemma D_rpow_IZR : forall (z : Z) (f : R -> R) (x l : R), is_derive f x l -> f x <> 0 ->
  is_derive (fun t => rpow (f t) (IZR z)) x (IZR z * rpow (f x) (IZR (z - 1)) * l).
Proof.
  intros z f x l F P. rewrite rpow_IZR.
  apply (is_derive_ext (fun t => powerRZ (f t) z)).
  - intro t. symmetry. apply rpow_IZR.
  - now apply D_powerRZ.
Qed.

Lemma D_rpow_INR : forall (n : nat) (f : R -> R) (x l : R), is_derive f x l ->
  is_derive (fun t => rpow (f t) (INR n)) x (INR n * l * f x ^ Nat.pred n).
Proof.
  intros n f x l F.
  apply (is_derive_ext (fun t => f t ^ n)).
  - intro t. symmetry. apply rpow_INR.
  - now apply D_pow.
Qed.

Lemma D_rpow_nat : forall (z : Z) (n : nat) (f : R -> R) (x l : R), Z.of_nat n = z -> is_derive f x l ->
  is_derive (fun t => rpow (f t) (IZR z)) x (IZR z * l * f x ^ Nat.pred n).
Proof. intros z n f x l <-. rewrite <- INR_IZR_INZ. apply D_rpow_INR. Qed.

Lemma is_derive_root : forall (n : nat) (x : R), (1 <= n)%nat -> 0 < x ->
  is_derive (root n) x (root n x / (INR n * x)).
Proof.
  intros n x N P. eapply D_equal; [exact (D_root n (fun t => t) x 1 (D_id x) N P) |].
  now rewrite Rmult_1_r.
Qed.

Lemma is_derive_rpow : forall (f g : R -> R) (x l m : R), is_derive f x l -> is_derive g x m -> 0 < f x ->
  is_derive (fun t => rpow (f t) (g t)) x (rpow (f x) (g x) * (m * ln (f x) + g x * l / f x)).
Proof. exact D_rpow. Qed.

(* Differentiation by the rules; what is left are side conditions and the equation of derivatives. *)

Ltac no_fact t :=
  lazymatch goal with
  | _ : t ^ _ = _ |- _ => fail
  | _ => idtac
  end.

Ltac new_sign f :=
  let t := type of f in
  lazymatch goal with
  | _ : t |- _ => fail
  | _ => generalize f; intro
  end.

(* What is known of the signs and bounds of functions in the goal. *)
Ltac known_signs :=
  repeat match goal with
  | |- context [root 2 ?x] => change (root 2 x) with (sqrt x)
  end;
  repeat match goal with
  | |- context [sqrt ?x] =>
    no_fact (sqrt x);
    let H := fresh in
    assert (H : sqrt x ^ 2 = x) by (apply pow2_sqrt; nra);
    generalize (sqrt_pos x); intro
  | |- context [exp ?x] => new_sign (exp_pos x)
  | |- context [sin ?x] => new_sign (SIN_bound x)
  | |- context [cos ?x] => new_sign (COS_bound x)
  | |- context [PI] => new_sign PI_RGT_0
  end.

Lemma ln_gt_0 : forall x : R, 1 < x -> 0 < ln x.
Proof. intros x H. rewrite <- ln_1. apply ln_increasing; lra. Qed.

Ltac side_condition :=
  cbv beta;
  first
  [ assumption
  | lra
  | lia
  | reflexivity
  | apply ExpPositive
  | apply ExpNonzero
  | match goal with
    | H : ?x > 0 |- ?x <> 0 => apply Rgt_not_eq; exact H
    | H : 0 < ?x |- ?x <> 0 => apply Rgt_not_eq; exact H
    | H : 0 < ?x |- sqrt ?x <> 0 => apply Rgt_not_eq, sqrt_lt_R0; exact H
    | |- sqrt ?x <> 0 => apply Rgt_not_eq, sqrt_lt_R0; side_condition
    | |- 0 < sqrt ?x => apply sqrt_lt_R0; side_condition
    | |- 0 < root _ ?x => apply root_gt_0; side_condition
    | |- root _ ?x <> 0 => apply Rgt_not_eq, root_gt_0; side_condition
    | |- _ /\ _ => split; side_condition
    | |- _ ^ _ <> 0 => apply pow_nonzero; side_condition
    | |- _ * _ <> 0 => apply Rmult_integral_contrapositive_currified; side_condition
    | |- / _ <> 0 => apply Rinv_neq_0_compat; side_condition
    | |- 0 < ln ?x => apply ln_gt_0; side_condition
    | |- ln ?x <> 0 => apply Rgt_not_eq, ln_gt_0; side_condition
    | |- INR _ <> 0 => apply Rgt_not_eq, INR_pos; lia
    | |- 0 < _ / _ => apply Rdiv_lt_0_compat; side_condition
    | |- 0 < / _ => apply Rinv_0_lt_compat; side_condition
    | |- _ / ?c < _ => apply Rlt_div_l; side_condition
    | |- _ < _ / ?c => apply Rlt_div_r; side_condition
    | |- 0 < rpow ?x ?y => rewrite (rpow_pos x y); [apply exp_pos | side_condition]
    | |- rpow ?x ?y <> 0 => rewrite (rpow_pos x y); [apply ExpNonzero | side_condition]
    end
  | nra
  | enclose
  | known_signs; first [lra | nra] ].

Ltac derive_node :=
  lazymatch goal with
  | |- is_derive (fun _ => ?c) ?x _ => exact (D_const c x)
  | |- is_derive (fun t => t) ?x _ => exact (D_id x)
  | |- is_derive (fun t => @?f t + @?g t) ?x _ => refine (D_plus f g x _ _ _ _)
  | |- is_derive (fun t => @?f t - @?g t) ?x _ => refine (D_minus f g x _ _ _ _)
  | |- is_derive (fun t => - @?f t) ?x _ => refine (D_opp f x _ _)
  | |- is_derive (fun t => @?f t * @?g t) ?x _ =>
    lazymatch f with
    | fun _ => ?c => refine (D_scal c g x _ _)
    | _ =>
      lazymatch g with
      | fun _ => ?c => refine (D_scal_r c f x _ _)
      | _ => refine (D_mult f g x _ _ _ _)
      end
    end
  | |- is_derive (fun t => @?f t / @?g t) ?x _ =>
    lazymatch g with
    | fun _ => ?c => refine (D_div_const c f x _ _)
    | _ => refine (D_div f g x _ _ _ _ _)
    end
  | |- is_derive (fun t => / @?f t) ?x _ => refine (D_inv f x _ _ _)
  | |- is_derive (fun t => @?f t ^ ?n) ?x _ => refine (D_pow f n x _ _)
  | |- is_derive (fun t => powerRZ (@?f t) ?z) ?x _ => refine (D_powerRZ f z x _ _ _)
  | |- is_derive (fun t => sin (@?f t)) ?x _ => refine (D_sin f x _ _)
  | |- is_derive (fun t => cos (@?f t)) ?x _ => refine (D_cos f x _ _)
  | |- is_derive (fun t => tan (@?f t)) ?x _ => refine (D_tan f x _ _ _)
  | |- is_derive (fun t => exp (@?f t)) ?x _ => refine (D_exp f x _ _)
  | |- is_derive (fun t => ln (@?f t)) ?x _ => refine (D_ln f x _ _ _)
  | |- is_derive (fun t => sqrt (@?f t)) ?x _ => refine (D_sqrt f x _ _ _)
  | |- is_derive (fun t => root 2 (@?f t)) ?x ?l => change (is_derive (fun t => sqrt (f t)) x l); cbv beta
  | |- is_derive (fun t => root ?n (@?f t)) ?x _ =>
    first
    [ refine (D_root n f x _ _ _ _); [| lia | side_condition]
    | refine (D_root_odd n f x _ _ _ _); [| reflexivity | side_condition]
    | refine (D_root n f x _ _ _ _) ]
  | |- is_derive (fun t => rpow (@?f t) (@?g t)) ?x _ =>
    lazymatch g with
    | fun _ => IZR ?z =>
      lazymatch z with
      | Zpos ?p =>
        let n := eval compute in (Pos.to_nat p) in
        refine (D_rpow_nat z n f x _ (eq_refl z) _)
      | _ => refine (D_rpow_IZR z f x _ _ _)
      end
    | fun _ => INR ?n => refine (D_rpow_INR n f x _ _)
    | fun _ => ?c => refine (D_rpow_const c f x _ _ _)
    | _ => refine (D_rpow f g x _ _ _ _ _)
    end
  | |- is_derive (fun t => atan (@?f t)) ?x _ => refine (D_atan f x _ _)
  | |- is_derive (fun t => asin (@?f t)) ?x _ => refine (D_asin f x _ _ _)
  | |- is_derive (fun t => acos (@?f t)) ?x _ => refine (D_acos f x _ _ _)
  | |- is_derive (fun t => Rabs (@?f t)) ?x _ => refine (D_Rabs f x _ _ _)
  | H : forall u : R, is_derive ?F u _ |- is_derive (fun t => ?F t) ?x _ => exact (H x)
  | H : forall u : R, is_derive ?F u _ |- is_derive (fun t => ?F (@?f t)) ?x _ => refine (D_chain F f x _ _ (H (f x)) _)
  | |- is_derive (fun t => _) _ _ => eassumption
  | |- is_derive ?f ?x ?l => first [eassumption | progress change (is_derive (fun t => f t) x l)]
  end.

(* Integer powers become powers with natural exponents, and exponents are counted out. *)
Ltac integer_powers :=
  repeat match goal with
  | |- context [(?a - 1)%Z] =>
    let b := eval compute in (a - 1)%Z in
    lazymatch b with
    | Z0 => idtac
    | Zpos _ => idtac
    | Zneg _ => idtac
    end;
    change (a - 1)%Z with b
  end;
  repeat match goal with |- context [root 2 ?x] => change (root 2 x) with (sqrt x) end;
  repeat rewrite rpow_INR;
  repeat rewrite rpow_IZR;
  repeat match goal with
  | |- context [powerRZ ?x Z0] => change (powerRZ x Z0) with 1
  | |- context [powerRZ ?x (Zpos ?p)] =>
    let n := eval compute in (Pos.to_nat p) in change (powerRZ x (Zpos p)) with (x ^ n)
  | |- context [powerRZ ?x (Zneg ?p)] =>
    let n := eval compute in (Pos.to_nat p) in change (powerRZ x (Zneg p)) with (/ x ^ n)
  end.

(* What powers of roots and sines are, of one root or sine of the goal that has no such fact yet. *)
Ltac new_fact H :=
  match goal with
  | |- context [sqrt ?x] => no_fact (sqrt x); assert (H : sqrt x ^ 2 = x) by (apply pow2_sqrt; side_condition)
  | |- context [root ?n ?x] =>
    no_fact (root n x); assert (H : root n x ^ n = x) by (apply RootPower; [lia | intro; side_condition])
  | |- context [sin ?x] =>
    no_fact (sin x);
    assert (H : sin x ^ 2 = 1 - cos x ^ 2) by (generalize (Pythagoras x); intro; lra)
  end.

Ltac equal_by_facts :=
  let A := fresh in
  new_fact A;
  first
  [ solve [ring [A] | field [A]; side_condition]
  | let B := fresh in
    new_fact B;
    first
    [ solve [ring [A B] | field [A B]; side_condition]
    | let D := fresh in
      new_fact D;
      first
      [ solve [ring [A B D] | field [A B D]; side_condition]
      | let E := fresh in
        new_fact E;
        solve [ring [A B D E] | field [A B D E]; side_condition] ] ] ].

(* Functions of sums, differences and multiples in functions of their parts. *)

Lemma exp_difference : forall a b : R, exp (a - b) = exp a / exp b.
Proof. intros a b. unfold Rminus. rewrite exp_plus, exp_Ropp. reflexivity. Qed.

Lemma exp_times : forall (z : Z) (n : nat) (x : R), Z.of_nat n = z -> exp (IZR z * x) = exp x ^ n.
Proof.
  intros z n x <-. rewrite <- INR_IZR_INZ. induction n as [| n IH].
  - simpl. rewrite Rmult_0_l. apply exp_0.
  - rewrite S_INR, Rmult_plus_distr_r, Rmult_1_l, exp_plus, IH. simpl. ring.
Qed.

Lemma rpow_plus : forall x a b : R, 0 < x -> rpow x (a + b) = rpow x a * rpow x b.
Proof. intros x a b P. rewrite !rpow_pos by exact P. rewrite Rmult_plus_distr_r. apply exp_plus. Qed.

Lemma rpow_difference : forall x a b : R, 0 < x -> rpow x (a - b) = rpow x a / rpow x b.
Proof. intros x a b P. rewrite !rpow_pos by exact P. rewrite Rmult_minus_distr_r. apply exp_difference. Qed.

Lemma rpow_negative : forall x a : R, 0 < x -> rpow x (- a) = / rpow x a.
Proof. intros x a P. rewrite !rpow_pos by exact P. rewrite Ropp_mult_distr_l_reverse. apply exp_Ropp. Qed.

Lemma rpow_positive : forall x a : R, 0 < x -> 0 < rpow x a.
Proof. intros x a P. rewrite rpow_pos by exact P. apply exp_pos. Qed.

Ltac expand_functions :=
  repeat match goal with
  | |- context [exp (IZR (Zpos ?p) * ?x)] =>
    let n := eval compute in (Pos.to_nat p) in rewrite (exp_times (Zpos p) n x (eq_refl (Zpos p)))
  | |- context [exp (?a + ?b)] => rewrite (exp_plus a b)
  | |- context [exp (?a - ?b)] => rewrite (exp_difference a b)
  | |- context [exp (- ?a)] => rewrite (exp_Ropp a)
  | |- context [rpow ?x (?a + ?b)] => rewrite (rpow_plus x a b) by side_condition
  | |- context [rpow ?x (?a - ?b)] => rewrite (rpow_difference x a b) by side_condition
  | |- context [rpow ?x (- ?a)] => rewrite (rpow_negative x a) by side_condition
  | |- context [sin (2 * ?x)] => rewrite (sin_2a x)
  | |- context [cos (2 * ?x)] => rewrite (cos_2a_cos x)
  | |- context [sin (?a + ?b)] => rewrite (sin_plus a b)
  | |- context [cos (?a + ?b)] => rewrite (cos_plus a b)
  | |- context [sin (?a - ?b)] => rewrite (sin_minus a b)
  | |- context [cos (?a - ?b)] => rewrite (cos_minus a b)
  | |- context [sin (- ?a)] => rewrite (sin_neg a)
  | |- context [cos (- ?a)] => rewrite (cos_neg a)
  end.

Ltac equal_plainly := first [ring | solve [field; side_condition] | solve [equal_by_facts]].

Ltac equal_values :=
  first
  [ reflexivity
  | ring
  | numerals; integer_powers; equal_plainly
  | numerals; expand_functions; integer_powers; equal_plainly ].

Ltac derivatives_equal :=
  cbv beta; cbn [Nat.pred];
  first
  [ equal_values
  | idtac ].

Ltac differentiate :=
  lazymatch goal with
  | |- is_derive ?f ?x ?l => refine (D_equal f x _ l _ _)
  end;
  [ repeat lazymatch goal with |- is_derive _ _ _ => derive_node end; try side_condition
  | derivatives_equal ].

Example differentiate_1 : forall x : R, is_derive (fun t => t ^ 3 * sin (2 * t) - exp (- t) / 5) x
  (3 * x ^ 2 * sin (2 * x) + 2 * x ^ 3 * cos (2 * x) + exp (- x) / 5).
Proof. intro x. differentiate. Qed.

Example differentiate_2 : forall x : R, 0 < x -> is_derive (fun t => ln t / t + root 3 t + atan t) x
  ((1 - ln x) / x ^ 2 + root 3 x / (3 * x) + 1 / (1 + x ^ 2)).
Proof. intros x H. differentiate. Qed.

Example differentiate_3 : forall x : R, -1 < x < 1 -> is_derive (fun t => asin t + acos t) x 0.
Proof. intros x H. differentiate. Qed.

Example differentiate_4 : forall a x : R, 0 < x -> is_derive (fun t => rpow t a + rpow t t) x
  (a * rpow x a / x + rpow x x * (ln x + 1)).
Proof. intros a x H. differentiate. Qed.

Example differentiate_5 : forall x : R, x < 0 -> is_derive (fun t => root 3 t + / t + rpow t (-2) + sqrt (1 - t)) x
  (root 3 x / (3 * x) - 1 / x ^ 2 - 2 * rpow x (-3) - 1 / (2 * sqrt (1 - x))).
Proof. intros x H. differentiate. Qed.

Example differentiate_6 : forall x : R, is_derive sin x (cos x).
Proof. intro x. differentiate. Qed.

Example differentiate_7 : forall x : R, is_derive (fun t => root 2 (1 + t ^ 2)) x (x / root 2 (1 + x ^ 2)).
Proof. intro x. differentiate. Qed.

Example differentiate_8 : forall x : R, -1 < x < 1 -> is_derive (fun t => asin t / 2 + t * sqrt (1 - t ^ 2) / 2) x
  (/ sqrt (1 - x ^ 2) / 2 + sqrt (1 - x ^ 2) / 2 - x ^ 2 / (2 * sqrt (1 - x ^ 2))).
Proof. intros x H. differentiate. Qed.

Example differentiate_9 : forall (F f : R -> R) (x : R), is_derive F x (f x) -> F x > 0 ->
  is_derive (fun t => ln (F t) + powerRZ (F t) (-2)) x (f x / F x - 2 * f x / F x ^ 3).
Proof. intros F f x D H. differentiate. Qed.

Example differentiate_10 : forall x : R, -1 < x < 1 -> is_derive (fun t => asin t / 2 + t * root 2 (1 - t ^ 2) / 2) x
  (root 2 (1 - x ^ 2)).
Proof. intros x H. differentiate. Qed.

Example differentiate_11 : forall x : R, cos x <> 0 -> is_derive (fun t => tan t - sin t ^ 3 / cos t) x (1 - 2 * sin x ^ 2).
Proof. intros x H. differentiate. Qed.

Example differentiate_12 : forall x : R, 0 < x -> is_derive (fun t => t * root 3 t) x (4 / 3 * root 3 x).
Proof. intros x H. differentiate. Qed.

Example differentiate_13 : forall x : R, 0 < x -> is_derive (root 3) x (1 / (3 * root 3 x ^ 2)).
Proof. intros x H. differentiate. Qed.

Example differentiate_14 : forall a x : R, is_derive (fun t => exp (a * t) / (a ^ 2 + 1) * (a * sin t - cos t)) x
  (exp (a * x) * sin x).
Proof. intros a x. differentiate. Qed.

Example differentiate_15 : forall x : R, is_derive (fun t => t / 2 - sin t * cos t / 2) x (sin x ^ 2).
Proof. intro x. differentiate. Qed.

Example differentiate_16 : forall x : R, is_derive (fun t => ln (t + root 2 (t ^ 2 + 1))) x (1 / root 2 (x ^ 2 + 1)).
Proof. intro x. differentiate. Qed.

Example differentiate_17 : forall x n : R, x > 0 -> n + 1 <> 0 ->
  is_derive (fun t => rpow t (n + 1) / (n + 1)) x (rpow x n).
Proof. intros x n X N. differentiate. Qed.

Example differentiate_18 : forall x : R, is_derive (fun t => sin (2 * t) + exp (2 * t) * exp (- t)) x
  (2 * cos x ^ 2 - 2 * sin x ^ 2 + exp x).
Proof. intro x. differentiate. Qed.

Example differentiate_19 : forall x : R, x > 1 -> is_derive (fun t => ln (ln t) + 1 / (2 + cos t)) x
  (1 / (x * ln x) + sin x / (2 + cos x) ^ 2).
Proof. intros x H. differentiate. Qed.

(* Complex numbers: principal values of logarithms, roots, powers and inverse functions. *)

Local Open Scope C_scope.

Definition creal (x : C) : Prop := Im x = 0%R.
Definition cpositive (x : C) : Prop := Im x = 0%R /\ (Re x > 0)%R.
Definition cnonneg (x : C) : Prop := Im x = 0%R /\ (Re x >= 0)%R.
Definition cinteger (x : C) : Prop := exists z : Z, x = RtoC (IZR z).

Definition cexp (z : C) : C := (exp (Re z) * cos (Im z), exp (Re z) * sin (Im z))%R.
Definition csin (z : C) : C := (sin (Re z) * cosh (Im z), cos (Re z) * sinh (Im z))%R.
Definition ccos (z : C) : C := (cos (Re z) * cosh (Im z), - (sin (Re z) * sinh (Im z)))%R.

Definition carg (z : C) : R :=
  (if Rle_dec 0 (Im z) then acos (Re z / Cmod z) else - acos (Re z / Cmod z))%R.

Definition cln (z : C) : C := (ln (Cmod z), carg z).

Definition croot (n : nat) (z : C) : C :=
  if Ceq_dec z 0 then RtoC 0 else cexp (cln z / INR n).

Fixpoint cpown (z : C) (n : nat) : C :=
  match n with
  | O => RtoC 1
  | S m => z * cpown z m
  end.

Definition cpowz (z : C) (k : Z) : C :=
  match k with
  | Z0 => RtoC 1
  | Zpos p => cpown z (Pos.to_nat p)
  | Zneg p => / cpown z (Pos.to_nat p)
  end.

Definition cpow (x y : C) : C :=
  if Ceq_dec y (IZR (Int_part (Re y))) then cpowz x (Int_part (Re y))
  else if Ceq_dec x 0 then RtoC 0
  else cexp (y * cln x).

Definition casin (z : C) : C := - Ci * cln (Ci * z + croot 2 (1 - z * z)).
Definition cacos (z : C) : C := RtoC (PI / 2) - casin z.
Definition catan (z : C) : C := Ci / 2 * (cln (1 - Ci * z) - cln (1 + Ci * z)).

Ltac parts := apply injective_projections; unfold Re, Im; simpl.

(* Real numbers among the complex ones. *)

Lemma creal_RtoC : forall x : C, creal x -> x = RtoC (Re x).
Proof. intros [a b] H. unfold creal, Im in H. simpl in H. rewrite H. reflexivity. Qed.

Lemma cpositive_RtoC : forall x : C, cpositive x -> exists r : R, x = RtoC r /\ (r > 0)%R.
Proof. intros x [H P]. exists (Re x). split; [now apply creal_RtoC | exact P]. Qed.

Lemma cnonneg_RtoC : forall x : C, cnonneg x -> exists r : R, x = RtoC r /\ (r >= 0)%R.
Proof. intros x [H P]. exists (Re x). split; [now apply creal_RtoC | exact P]. Qed.

Lemma RtoC_cpositive : forall r : R, (r > 0)%R -> cpositive (RtoC r).
Proof. intros r H. now split. Qed.

Lemma RtoC_cnonneg : forall r : R, (r >= 0)%R -> cnonneg (RtoC r).
Proof. intros r H. now split. Qed.

Lemma RtoC_creal : forall r : R, creal (RtoC r).
Proof. intro r. reflexivity. Qed.

Lemma integer_cinteger : forall r : R, integer r -> cinteger (RtoC r).
Proof. intros r [z ->]. now exists z. Qed.

Lemma RtoC_neq : forall x : R, x <> 0%R -> RtoC x <> 0.
Proof. intros x H F. apply H, RtoC_inj, F. Qed.

Lemma cexp_R : forall x : R, cexp (RtoC x) = RtoC (exp x).
Proof. intro x. parts; rewrite ?cos_0, ?sin_0; ring. Qed.

Lemma csin_R : forall x : R, csin (RtoC x) = RtoC (sin x).
Proof. intro x. parts; rewrite ?cosh_0, ?sinh_0; ring. Qed.

Lemma ccos_R : forall x : R, ccos (RtoC x) = RtoC (cos x).
Proof. intro x. parts; rewrite ?cosh_0, ?sinh_0; ring. Qed.

(* Exponential function, sines and cosines. *)

Lemma C_ImaginarySquare : cpown Ci 2 = RtoC (-1).
Proof. parts; ring. Qed.

Lemma C_ExpOfImaginary : forall x : C, cexp (Ci * x) = ccos x + Ci * csin x.
Proof.
  intros [a b]. unfold cexp, ccos, csin, cosh, sinh. parts;
    replace (0 * a - 1 * b)%R with (- b)%R by ring; replace (0 * b + 1 * a)%R with a by ring; field.
Qed.

Lemma C_Pythagoras : forall x : C, cpown (csin x) 2 + cpown (ccos x) 2 = 1.
Proof.
  intros [a b].
  assert (E : (exp b * exp (- b) = 1)%R) by (rewrite <- exp_plus, Rplus_opp_r; apply exp_0).
  generalize (Pythagoras a). intro P.
  unfold csin, ccos, cosh, sinh. parts; [| field].
  transitivity ((sin a ^ 2 + cos a ^ 2) * (exp b * exp (- b)))%R; [simpl; field | rewrite P, E; ring].
Qed.

Lemma C_SineOfSum : forall s a b : C, s = a + b -> csin s = csin a * ccos b + ccos a * csin b.
Proof.
  intros s [a1 a2] [b1 b2] ->. unfold csin, ccos, cosh, sinh. parts;
    rewrite ?sin_plus, ?cos_plus, ?Ropp_plus_distr, ?exp_plus; field.
Qed.

Lemma C_CosineOfSum : forall s a b : C, s = a + b -> ccos s = ccos a * ccos b - csin a * csin b.
Proof.
  intros s [a1 a2] [b1 b2] ->. unfold csin, ccos, cosh, sinh. parts;
    rewrite ?sin_plus, ?cos_plus, ?Ropp_plus_distr, ?exp_plus; field.
Qed.

Lemma C_SineOfNegative : forall s a : C, s = - a -> csin s = - csin a.
Proof.
  intros s [a b] ->. unfold csin, cosh, sinh. parts; rewrite ?sin_neg, ?cos_neg, ?Ropp_involutive; field.
Qed.

Lemma C_CosineOfNegative : forall s a : C, s = - a -> ccos s = ccos a.
Proof.
  intros s [a b] ->. unfold ccos, cosh, sinh. parts; rewrite ?sin_neg, ?cos_neg, ?Ropp_involutive; field.
Qed.

Lemma C_SineOfZero : forall s : C, s = 0 -> csin s = 0.
Proof. intros s ->. rewrite csin_R. f_equal. apply sin_0. Qed.

Lemma C_CosineOfZero : forall s : C, s = 0 -> ccos s = 1.
Proof. intros s ->. rewrite ccos_R. f_equal. apply cos_0. Qed.

Lemma C_SineOfPi : csin PI = 0.
Proof. rewrite csin_R. f_equal. apply sin_PI. Qed.

Lemma C_CosineOfPi : ccos PI = RtoC (-1).
Proof. rewrite ccos_R. f_equal. apply cos_PI. Qed.

Lemma C_ExpOfSum : forall s a b : C, s = a + b -> cexp s = cexp a * cexp b.
Proof.
  intros s [a1 a2] [b1 b2] ->. parts; rewrite ?exp_plus, ?cos_plus, ?sin_plus; ring.
Qed.

Lemma C_ExpOfZero : forall s : C, s = 0 -> cexp s = 1.
Proof. intros s ->. rewrite cexp_R. f_equal. apply exp_0. Qed.

Lemma C_ExpNonzero : forall x : C, cexp x <> 0.
Proof.
  intros x F.
  assert (H : cexp x * cexp (- x) = 1).
  { rewrite <- (C_ExpOfSum (x + - x)) by reflexivity. apply C_ExpOfZero. ring. }
  rewrite F, Cmult_0_l in H. injection H. lra.
Qed.

Lemma C_SineOfHalfTurns : forall n : C, cinteger n -> csin (RtoC PI * n) = 0.
Proof.
  intros n [z ->]. rewrite <- RtoC_mult, csin_R. f_equal. apply SineOfHalfTurns. now exists z.
Qed.

Lemma C_CosineOfTurns : forall n : C, cinteger n -> ccos (RtoC 2 * RtoC PI * n) = 1.
Proof.
  intros n [z ->]. rewrite <- !RtoC_mult, ccos_R. f_equal. apply CosineOfTurns. now exists z.
Qed.

Lemma C_SinePositive : forall x : C, creal x -> cpositive x -> cpositive (RtoC PI - x) -> cpositive (csin x).
Proof.
  intros x R [_ P] [_ Q]. rewrite (creal_RtoC x R) in *. rewrite csin_R. apply RtoC_cpositive.
  unfold Re in P, Q. simpl in P, Q. apply SinePositive; [exact P | unfold Re; lra].
Qed.

Lemma C_AngleUnique : forall a b : C, creal a -> creal b -> csin a = csin b -> ccos a = ccos b ->
  cpositive (RtoC 2 * RtoC PI - (a - b)) -> cpositive (RtoC 2 * RtoC PI + (a - b)) -> a = b.
Proof.
  intros a b A B S K [_ P] [_ Q].
  rewrite (creal_RtoC a A), (creal_RtoC b B) in *.
  rewrite !csin_R in S. rewrite !ccos_R in K. apply RtoC_inj in S. apply RtoC_inj in K.
  unfold Re in *. simpl in *.
  f_equal. apply AngleUnique; try assumption; lra.
Qed.

Lemma C_ExpPositive : forall x : C, creal x -> cpositive (cexp x).
Proof. intros x R. rewrite (creal_RtoC x R), cexp_R. apply RtoC_cpositive, exp_pos. Qed.

Lemma C_ExpInjective : forall a b : C, creal a -> creal b -> cexp a = cexp b -> a = b.
Proof.
  intros a b A B E. rewrite (creal_RtoC a A), (creal_RtoC b B) in *.
  rewrite !cexp_R in E. apply RtoC_inj in E. f_equal. now apply exp_inv.
Qed.

(* The principal argument. *)

Lemma Cmod_square : forall z : C, (Cmod z * Cmod z = Re z ^ 2 + Im z ^ 2)%R.
Proof. intros [a b]. apply sqrt_sqrt. simpl. nra. Qed.

Lemma carg_cos : forall z : C, z <> 0 -> (Cmod z * cos (carg z) = Re z)%R.
Proof.
  intros z N. assert (P : (0 < Cmod z)%R) by now apply Cmod_gt_0.
  generalize (Cmod_square z). intro S.
  assert (B : (-1 <= Re z / Cmod z <= 1)%R).
  { split; [apply Rle_div_r | apply Rle_div_l]; try exact P; nra. }
  unfold carg. destruct (Rle_dec 0 (Im z)); rewrite ?cos_neg, cos_acos by exact B; field; lra.
Qed.

Lemma carg_sin : forall z : C, z <> 0 -> (Cmod z * sin (carg z) = Im z)%R.
Proof.
  intros z N. assert (P : (0 < Cmod z)%R) by now apply Cmod_gt_0.
  generalize (Cmod_square z). intro S.
  assert (B : (-1 <= Re z / Cmod z <= 1)%R).
  { split; [apply Rle_div_r | apply Rle_div_l]; try exact P; nra. }
  assert (Q : (Cmod z * sqrt (1 - (Re z / Cmod z)²) = Rabs (Im z))%R).
  { rewrite <- (sqrt_Rsqr (Cmod z)) at 1 by lra. rewrite <- sqrt_mult_alt by apply Rle_0_sqr.
    rewrite <- sqrt_Rsqr_abs. f_equal. unfold Rsqr. field_simplify; [| lra].
    simpl in *. lra. }
  unfold carg. destruct (Rle_dec 0 (Im z)) as [H | H]; rewrite ?sin_neg, sin_acos by exact B.
  - rewrite Q. now apply Rabs_pos_eq.
  - rewrite Ropp_mult_distr_r_reverse, Q, Rabs_left; lra.
Qed.

Lemma carg_bound : forall z : C, z <> 0 -> (- PI < carg z <= PI)%R.
Proof.
  intros z N. unfold carg.
  destruct (acos_bound (Re z / Cmod z)) as [H1 H2].
  generalize PI_RGT_0. intro P.
  destruct (Rle_dec 0 (Im z)) as [H | H]; [lra |].
  split; [| lra].
  destruct (Req_dec (acos (Re z / Cmod z)) PI) as [E | E]; [| lra].
  exfalso. generalize (carg_sin z N). unfold carg.
  destruct (Rle_dec 0 (Im z)); [contradiction |].
  rewrite E, sin_neg, sin_PI. lra.
Qed.

Lemma carg_unique : forall (z : C) (u : R), z <> 0 -> (- PI < u <= PI)%R ->
  (Cmod z * cos u = Re z)%R -> (Cmod z * sin u = Im z)%R -> carg z = u.
Proof.
  intros z u N [B1 B2] K S. assert (P : (0 < Cmod z)%R) by now apply Cmod_gt_0.
  generalize (carg_cos z N) (carg_sin z N) (carg_bound z N). intros K' S' [B1' B2'].
  apply AngleUnique; try lra.
  - apply (Rmult_eq_reg_l (Cmod z)); lra.
  - apply (Rmult_eq_reg_l (Cmod z)); lra.
Qed.

(* Logarithms. *)

Lemma C_ExpOfLn : forall x : C, x <> 0 -> cexp (cln x) = x.
Proof.
  intros x N. assert (P : (0 < Cmod x)%R) by now apply Cmod_gt_0.
  parts; rewrite exp_ln by exact P; [now apply carg_cos | now apply carg_sin].
Qed.

Lemma cln_cexp : forall w : C, (- PI < Im w <= PI)%R -> cln (cexp w) = w.
Proof.
  intros [a b] B. unfold Im in B. simpl in B.
  assert (M : Cmod (cexp (a, b)) = exp a).
  { unfold Cmod, cexp, Re, Im. simpl.
    replace (exp a * cos b * (exp a * cos b * 1) + exp a * sin b * (exp a * sin b * 1))%R
      with (exp a * exp a * (sin b ^ 2 + cos b ^ 2))%R by ring.
    rewrite Pythagoras, Rmult_1_r. apply sqrt_square. left. apply exp_pos. }
  unfold cln. parts.
  - rewrite M. apply ln_exp.
  - apply carg_unique; [apply C_ExpNonzero | exact B | rewrite M; reflexivity | rewrite M; reflexivity].
Qed.

Lemma cln_R : forall x : R, (0 < x)%R -> cln (RtoC x) = RtoC (ln x).
Proof.
  intros x P. rewrite <- (exp_ln x P) at 1. rewrite <- cexp_R. apply cln_cexp.
  generalize PI_RGT_0. unfold Im. simpl. lra.
Qed.

Lemma C_LnOfExp : forall x : C, creal x -> cln (cexp x) = x.
Proof.
  intros x R. apply cln_cexp. unfold creal in R. rewrite R. generalize PI_RGT_0. lra.
Qed.

Lemma C_LnOfNegative : forall x : C, creal x -> cpositive x -> cln (- x) = cln x + Ci * RtoC PI.
Proof.
  intros x _ P. destruct (cpositive_RtoC x P) as [r [-> H]].
  rewrite cln_R by exact H.
  assert (E : - RtoC r = cexp (RtoC (ln r) + Ci * RtoC PI)).
  { rewrite (C_ExpOfSum _ (RtoC (ln r)) (Ci * RtoC PI)) by reflexivity.
    rewrite cexp_R, exp_ln, C_ExpOfImaginary, ccos_R, csin_R, cos_PI, sin_PI by exact H.
    parts; ring. }
  rewrite E. apply cln_cexp. unfold Im. simpl. generalize PI_RGT_0. lra.
Qed.

(* Powers with natural and integer exponents. *)

Lemma cpown_add : forall (x : C) (n m : nat), cpown x (n + m) = cpown x n * cpown x m.
Proof. intros x n m. induction n as [| n IH]; simpl; [ring | rewrite IH; ring]. Qed.

Lemma cpown_mult : forall (x y : C) (n : nat), cpown (x * y) n = cpown x n * cpown y n.
Proof. intros x y n. induction n as [| n IH]; simpl; [ring | rewrite IH; ring]. Qed.

Lemma cpown_cpown : forall (x : C) (n m : nat), cpown (cpown x n) m = cpown x (n * m).
Proof.
  intros x n m. induction m as [| m IH]; simpl.
  - now rewrite Nat.mul_0_r.
  - rewrite IH, Nat.mul_succ_r, Nat.add_comm, cpown_add. reflexivity.
Qed.

Lemma cpown_one : forall n : nat, cpown 1 n = 1.
Proof. induction n as [| n IH]; simpl; [reflexivity | rewrite IH; ring]. Qed.

Lemma cpown_neq_0 : forall (x : C) (n : nat), x <> 0 -> cpown x n <> 0.
Proof.
  intros x n N. induction n as [| n IH]; simpl; [| now apply Cmult_neq_0].
  apply RtoC_neq. lra.
Qed.

Lemma cpown_0 : forall n : nat, (0 < n)%nat -> cpown 0 n = 0.
Proof. intros [| n] H; [lia | simpl; ring]. Qed.

Lemma cpown_R : forall (x : R) (n : nat), cpown (RtoC x) n = RtoC (x ^ n).
Proof. intros x n. induction n as [| n IH]; simpl; [reflexivity | rewrite IH, RtoC_mult; reflexivity]. Qed.

Lemma cpown_cexp : forall (z : C) (n : nat), cpown (cexp z) n = cexp (RtoC (INR n) * z).
Proof.
  intros z n. induction n as [| n IH].
  - simpl. symmetry. apply C_ExpOfZero. ring.
  - simpl cpown. rewrite IH. symmetry. apply C_ExpOfSum. rewrite S_INR, RtoC_plus. ring.
Qed.

Lemma cinv_0 : / RtoC 0 = 0.
Proof. parts; unfold Rdiv; ring. Qed.

Lemma cinv_inv : forall x : C, / / x = x.
Proof.
  intro x. destruct (Ceq_dec x 0) as [-> | N]; [now rewrite !cinv_0 |].
  assert (M : / x <> 0).
  { intro F. generalize (Cinv_r x N). rewrite F, Cmult_0_r. intro E. injection E. lra. }
  rewrite <- (Cmult_1_l (/ / x)), <- (Cinv_r x N), <- Cmult_assoc, (Cinv_r (/ x) M). ring.
Qed.

Lemma cinv_mult : forall x y : C, / (x * y) = / x * / y.
Proof.
  intros x y. destruct (Ceq_dec x 0) as [-> | N]; [rewrite Cmult_0_l, cinv_0; ring |].
  destruct (Ceq_dec y 0) as [-> | M]; [rewrite Cmult_0_r, cinv_0; ring |].
  field. now split.
Qed.

Lemma cpowz_nat : forall (x : C) (n : nat), cpowz x (Z.of_nat n) = cpown x n.
Proof.
  intros x [| n]; [reflexivity |]. simpl Z.of_nat. unfold cpowz. now rewrite SuccNat2Pos.id_succ.
Qed.

Lemma cpowz_opp : forall (x : C) (k : Z), cpowz x (- k) = / cpowz x k.
Proof.
  intros x [| p | p]; simpl.
  - parts; field.
  - reflexivity.
  - symmetry. apply cinv_inv.
Qed.

Lemma cinv_cpown : forall (x : C) (n : nat), cpown (/ x) n = / cpown x n.
Proof.
  intros x n. induction n as [| n IH]; simpl; [parts; field |].
  rewrite IH, cinv_mult. reflexivity.
Qed.

Lemma cpowz_mult : forall (x y : C) (k : Z), cpowz (x * y) k = cpowz x k * cpowz y k.
Proof.
  intros x y [| p | p]; simpl; [ring | apply cpown_mult | rewrite cpown_mult; apply cinv_mult].
Qed.

Lemma cpowz_neq_0 : forall (x : C) (k : Z), x <> 0 -> cpowz x k <> 0.
Proof.
  intros x [| p | p] N; simpl.
  - apply RtoC_neq. lra.
  - now apply cpown_neq_0.
  - intro F. generalize (cpown_neq_0 x (Pos.to_nat p) N). intro M.
    generalize (Cinv_r _ M). rewrite F, Cmult_0_r. intro E. injection E. lra.
Qed.

Lemma cpowz_cexp : forall (z : C) (k : Z), cpowz (cexp z) k = cexp (RtoC (IZR k) * z).
Proof.
  intros z k. destruct (Z_le_gt_dec 0 k) as [H | H].
  - rewrite <- (Z2Nat.id k H), cpowz_nat, cpown_cexp, INR_IZR_INZ. reflexivity.
  - replace k with (- Z.of_nat (Z.to_nat (- k)))%Z by lia.
    set (n := Z.to_nat (- k)). rewrite cpowz_opp, cpowz_nat, cpown_cexp.
    rewrite opp_IZR, <- INR_IZR_INZ, RtoC_opp.
    set (w := RtoC (INR n) * z).
    replace (- RtoC (INR n) * z) with (- w) by (unfold w; ring).
    assert (E : cexp w * cexp (- w) = 1).
    { rewrite <- (C_ExpOfSum (w + - w)) by reflexivity. apply C_ExpOfZero. ring. }
    rewrite <- (Cmult_1_r (/ cexp w)), <- E, Cmult_assoc, Cinv_l by apply C_ExpNonzero.
    ring.
Qed.

Lemma cpowz_add : forall (x : C) (a b : Z), x <> 0 -> cpowz x (a + b) = cpowz x a * cpowz x b.
Proof.
  intros x a b N. rewrite <- (C_ExpOfLn x N), !cpowz_cexp, plus_IZR, RtoC_plus.
  apply C_ExpOfSum. ring.
Qed.

Lemma cpowz_nonneg_add : forall (x : C) (a b : Z), (0 <= a)%Z -> (0 <= b)%Z ->
  cpowz x (a + b) = cpowz x a * cpowz x b.
Proof.
  intros x a b A B. rewrite <- (Z2Nat.id a A), <- (Z2Nat.id b B), <- Nat2Z.inj_add, !cpowz_nat.
  apply cpown_add.
Qed.

Lemma cpowz_cpowz : forall (x : C) (a b : Z), x <> 0 -> cpowz (cpowz x a) b = cpowz x (a * b).
Proof.
  intros x a b N. rewrite <- (C_ExpOfLn x N), !cpowz_cexp, mult_IZR, RtoC_mult. f_equal. ring.
Qed.

Lemma cpowz_R : forall (x : R) (k : Z), x <> 0%R -> cpowz (RtoC x) k = RtoC (powerRZ x k).
Proof.
  intros x [| p | p] N; simpl; [reflexivity | apply cpown_R |].
  rewrite cpown_R, RtoC_inv; [reflexivity | now apply pow_nonzero].
Qed.

Lemma cpow_IZR : forall (x : C) (z : Z), cpow x (RtoC (IZR z)) = cpowz x z.
Proof.
  intros x z. unfold cpow, Re. simpl fst. rewrite Int_part_IZR.
  destruct (Ceq_dec (RtoC (IZR z)) (RtoC (IZR z))) as [_ | F]; [reflexivity | now elim F].
Qed.

(* Powers. *)

Lemma C_ComplexPower : forall x y : C, x <> 0 -> cpow x y = cexp (y * cln x).
Proof.
  intros x y N. unfold cpow.
  destruct (Ceq_dec y (RtoC (IZR (Int_part (Re y))))) as [E | E].
  - rewrite E at 2. rewrite <- (C_ExpOfLn x N) at 1. apply cpowz_cexp.
  - destruct (Ceq_dec x 0); [contradiction | reflexivity].
Qed.

Lemma C_RealPower : forall x y : C, cpositive x -> cpow x y = cexp (y * cln x).
Proof.
  intros x y P. apply C_ComplexPower. destruct (cpositive_RtoC x P) as [r [-> H]].
  apply RtoC_neq. lra.
Qed.

Lemma cpow_R : forall x y : R, (0 < x)%R -> cpow (RtoC x) (RtoC y) = RtoC (rpow x y).
Proof.
  intros x y P. rewrite C_ComplexPower by (apply RtoC_neq; lra).
  now rewrite cln_R, <- RtoC_mult, cexp_R, rpow_pos.
Qed.

Lemma C_IntegerPower : forall (x p : C) (n : nat), p = RtoC (INR n) -> cpow x p = cpown x n.
Proof. intros x p n ->. rewrite INR_IZR_INZ, cpow_IZR. apply cpowz_nat. Qed.

Lemma C_NegativePower : forall (x p : C) (n : nat), p = - RtoC (INR n) -> x <> 0 -> cpow x p = 1 / cpown x n.
Proof.
  intros x p n -> N. rewrite <- RtoC_opp, INR_IZR_INZ, <- opp_IZR, cpow_IZR, cpowz_opp, cpowz_nat.
  unfold Cdiv. ring.
Qed.

Lemma C_PowerOfSum : forall x s a b : C, s = a + b -> cinteger a -> cinteger b -> cnonneg a -> cnonneg b ->
  cpow x s = cpow x a * cpow x b.
Proof.
  intros x s a b -> [n ->] [m ->] [_ N] [_ M]. rewrite <- RtoC_plus, <- plus_IZR, !cpow_IZR.
  unfold Re in N, M. simpl in N, M. apply cpowz_nonneg_add; apply le_IZR; lra.
Qed.

Lemma C_NonzeroPowerOfSum : forall x s a b : C, s = a + b -> cinteger a -> cinteger b -> x <> 0 ->
  cpow x s = cpow x a * cpow x b.
Proof.
  intros x s a b -> [n ->] [m ->] N. rewrite <- RtoC_plus, <- plus_IZR, !cpow_IZR. now apply cpowz_add.
Qed.

Lemma C_PowerOfProduct : forall p a b n : C, p = a * b -> cinteger n -> cnonneg n -> cpow p n = cpow a n * cpow b n.
Proof. intros p a b n -> [z ->] _. rewrite !cpow_IZR. apply cpowz_mult. Qed.

Lemma C_NonzeroPowerOfProduct : forall p a b n : C, p = a * b -> cinteger n -> a <> 0 -> b <> 0 ->
  cpow p n = cpow a n * cpow b n.
Proof. intros p a b n -> [z ->] _ _. rewrite !cpow_IZR. apply cpowz_mult. Qed.

Lemma C_PowerOfPower : forall x p n m : C, p = n * m -> cinteger n -> cinteger m -> x <> 0 ->
  cpow (cpow x n) m = cpow x p.
Proof.
  intros x p n m -> [a ->] [b ->] N. rewrite <- RtoC_mult, <- mult_IZR, !cpow_IZR. now apply cpowz_cpowz.
Qed.

Lemma C_PowerNonzero : forall x n : C, x <> 0 -> cinteger n -> cpow x n <> 0.
Proof. intros x n N [z ->]. rewrite cpow_IZR. now apply cpowz_neq_0. Qed.

Lemma C_PowerOfOne : forall x y : C, x = 1 -> cpow x y = 1.
Proof.
  intros x y ->. rewrite C_ComplexPower by (apply RtoC_neq; lra).
  rewrite cln_R, ln_1 by lra. apply C_ExpOfZero. ring.
Qed.

Lemma C_CosineOfHalfTurns : forall n : C, cinteger n -> ccos (RtoC PI * n) = cpow (RtoC (-1)) n.
Proof.
  intros n [z ->]. rewrite cpow_IZR, cpowz_R by lra.
  rewrite <- RtoC_mult, ccos_R, CosineOfHalfTurns by now exists z. now rewrite rpow_IZR.
Qed.

Lemma C_IntegerAtLeastOne : forall n : C, creal n -> cinteger n -> cpositive n -> cnonneg (n - 1).
Proof.
  intros n _ [z ->] [_ P]. unfold Re in P. simpl in P. rewrite <- RtoC_minus.
  apply RtoC_cnonneg. generalize (IntegerAtLeastOne (IZR z) (ex_intro _ z eq_refl) P). lra.
Qed.

(* Roots. *)

Lemma croot_0 : forall n : nat, croot n 0 = 0.
Proof. intro n. unfold croot. destruct (Ceq_dec 0 0) as [_ | F]; [reflexivity | now elim F]. Qed.

Lemma croot_nonzero : forall (n : nat) (x : C), x <> 0 -> croot n x = cexp (cln x / INR n).
Proof. intros n x N. unfold croot. destruct (Ceq_dec x 0); [contradiction | reflexivity]. Qed.

Lemma INR_C_neq_0 : forall n : nat, (1 <= n)%nat -> RtoC (INR n) <> 0.
Proof. intros n H. apply RtoC_neq, Rgt_not_eq, INR_pos, H. Qed.

Lemma C_RootPower : forall (n : nat) (x : C), (2 <= n)%nat -> cpown (croot n x) n = x.
Proof.
  intros n x H. destruct (Ceq_dec x 0) as [-> | N].
  - rewrite croot_0. apply cpown_0. lia.
  - rewrite croot_nonzero, cpown_cexp by exact N. rewrite <- (C_ExpOfLn x N) at 2. f_equal.
    field. apply INR_C_neq_0. lia.
Qed.

Lemma croot_R : forall (n : nat) (x : R), (1 <= n)%nat -> (0 <= x)%R -> croot n (RtoC x) = RtoC (root n x).
Proof.
  intros n x N [P | <-]; [| rewrite root_0; apply croot_0].
  rewrite croot_nonzero by (apply RtoC_neq; lra).
  rewrite cln_R, <- RtoC_div, cexp_R, root_pos; trivial.
  apply Rgt_not_eq, INR_pos, N.
Qed.

Lemma C_RootUnique : forall (n : nat) (x y : C), (2 <= n)%nat -> creal y -> cnonneg y -> cpown y n = x -> croot n x = y.
Proof.
  intros n x y H _ Y <-. destruct (cnonneg_RtoC y Y) as [r [-> P]].
  rewrite cpown_R, croot_R; [| lia | apply pow_le; lra].
  f_equal. now apply (RootUnique n).
Qed.

Lemma C_RootOfNegative : forall x : C, creal x -> cnonneg x -> croot 2 (- x) = Ci * croot 2 x.
Proof.
  intros x _ P. destruct (cnonneg_RtoC x P) as [r [-> [H | ->]]].
  - assert (N : RtoC r <> 0) by (apply RtoC_neq; lra).
    assert (M : - RtoC r <> 0) by (rewrite <- RtoC_opp; apply RtoC_neq; lra).
    rewrite !croot_nonzero by assumption.
    rewrite C_LnOfNegative by (try apply RtoC_cpositive; trivial; reflexivity).
    rewrite (C_ExpOfSum _ (Ci * RtoC (PI / 2)) (cln (RtoC r) / RtoC (INR 2))).
    + f_equal. rewrite C_ExpOfImaginary, ccos_R, csin_R, cos_PI2, sin_PI2. parts; ring.
    + rewrite cln_R by exact H. parts; field.
  - rewrite <- RtoC_opp, Ropp_0, croot_0. ring.
Qed.

(* Inverse functions. *)

Lemma csin_exp : forall z : C, csin z = (cexp (Ci * z) - cexp (- (Ci * z))) / (2 * Ci).
Proof.
  intro z. replace (- (Ci * z)) with (Ci * - z) by ring.
  rewrite !C_ExpOfImaginary, (C_SineOfNegative (- z) z), (C_CosineOfNegative (- z) z) by reflexivity.
  generalize (csin z) (ccos z). intros [a b] [c d]. parts; field.
Qed.

Lemma C_SineOfArcsin : forall x : C, csin (casin x) = x.
Proof.
  intro x. unfold casin. set (q := croot 2 (1 - x * x)).
  assert (Q : q * q = 1 - x * x).
  { generalize (C_RootPower 2 (1 - x * x) (le_n 2)). simpl. fold q. rewrite Cmult_1_r. trivial. }
  set (w := Ci * x + q).
  assert (I : Ci * Ci = - (1)) by (parts; ring).
  assert (W : w * (q - Ci * x) = 1).
  { unfold w. replace ((Ci * x + q) * (q - Ci * x)) with (q * q - Ci * Ci * (x * x)) by ring. rewrite Q, I. ring. }
  assert (N : w <> 0).
  { intro F. rewrite F, Cmult_0_l in W. injection W. lra. }
  rewrite csin_exp.
  replace (Ci * (- Ci * cln w)) with (- (Ci * Ci) * cln w) by ring. rewrite I.
  replace (- - (1) * cln w) with (cln w) by ring.
  assert (V : cexp (- cln w) = q - Ci * x).
  { assert (E : w * cexp (- cln w) = 1).
    { rewrite <- (C_ExpOfLn w N) at 1. rewrite <- (C_ExpOfSum (cln w + - cln w)) by reflexivity.
      apply C_ExpOfZero. ring. }
    rewrite <- (Cmult_1_l (cexp _)), <- (Cinv_l w N), <- Cmult_assoc, E, <- W, Cmult_assoc, (Cinv_l w N). ring. }
  rewrite V, C_ExpOfLn by exact N. unfold w.
  generalize q. intros [c d]. destruct x as [a b]. parts; field.
Qed.

Lemma C_CosineOfArccos : forall x : C, ccos (cacos x) = x.
Proof.
  intro x. unfold cacos, Cminus.
  rewrite (C_CosineOfSum _ (RtoC (PI / 2)) (- casin x)) by reflexivity.
  rewrite ccos_R, csin_R, cos_PI2, sin_PI2, (C_SineOfNegative _ (casin x)), C_SineOfArcsin by reflexivity.
  ring.
Qed.

Lemma Cmod_1_ix : forall x : R, (Cmod (1, x) * cos (atan x) = 1 /\ Cmod (1, x) * sin (atan x) = x)%R.
Proof.
  intro x.
  assert (P : (0 < cos (atan x))%R) by apply CosineOfArctan.
  assert (M : (0 < Cmod (1, x))%R).
  { apply Cmod_gt_0. intro F. injection F. lra. }
  generalize (Cmod_square (1%R, x)) (Pythagoras (atan x)) (SineOfArctan x). unfold Re, Im. simpl.
  intros S Y T. rewrite T in Y.
  assert (K : (Cmod (1, x) * cos (atan x) = 1)%R).
  { assert (E : ((Cmod (1, x) * cos (atan x)) * (Cmod (1, x) * cos (atan x)) = 1)%R).
    { transitivity ((Cmod (1, x) * Cmod (1, x)) * (cos (atan x) * cos (atan x)))%R; [ring | rewrite S; lra]. }
    assert (G : (0 < Cmod (1, x) * cos (atan x))%R) by now apply Rmult_lt_0_compat.
    nra. }
  split; [exact K |]. rewrite T.
  transitivity (x * (Cmod (1, x) * cos (atan x)))%R; [ring | rewrite K; ring].
Qed.

Lemma carg_1_ix : forall x : R, carg (1%R, x) = atan x.
Proof.
  intro x. destruct (Cmod_1_ix x) as [K S]. destruct (atan_bound x) as [B1 B2]. generalize PI_RGT_0. intro P.
  apply carg_unique; [intro F; injection F; lra | lra | exact K | exact S].
Qed.

Lemma catan_R : forall x : R, catan (RtoC x) = RtoC (atan x).
Proof.
  intro x. unfold catan.
  replace (RtoC 1 - Ci * RtoC x) with ((1, - x)%R : C) by (parts; ring).
  replace (RtoC 1 + Ci * RtoC x) with ((1, x)%R : C) by (parts; ring).
  unfold cln. rewrite !carg_1_ix, atan_opp.
  replace (Cmod (1, - x)%R) with (Cmod (1, x)%R) by (unfold Cmod; f_equal; simpl; ring).
  parts; field.
Qed.

Lemma C_SineOfArctan : forall x : C, creal x -> csin (catan x) = x * ccos (catan x).
Proof.
  intros x R. rewrite (creal_RtoC x R), catan_R, csin_R, ccos_R, <- RtoC_mult. f_equal. apply SineOfArctan.
Qed.

Lemma C_CosineOfArctan : forall x : C, creal x -> cpositive (ccos (catan x)).
Proof.
  intros x R. rewrite (creal_RtoC x R), catan_R, ccos_R. apply RtoC_cpositive, CosineOfArctan.
Qed.

Lemma C_ArctanOfZero : forall x : C, x = 0 -> catan x = 0.
Proof. intros x ->. rewrite catan_R. f_equal. apply atan_0. Qed.

Lemma C_ArctanAbove : forall x : C, creal x -> cpositive (catan x + RtoC PI / RtoC 2).
Proof.
  intros x R. rewrite (creal_RtoC x R), catan_R, <- RtoC_div, <- RtoC_plus by lra. apply RtoC_cpositive, ArctanAbove.
Qed.

Lemma C_ArctanBelow : forall x : C, creal x -> cpositive (RtoC PI / RtoC 2 - catan x).
Proof.
  intros x R. rewrite (creal_RtoC x R), catan_R, <- RtoC_div, <- RtoC_minus by lra. apply RtoC_cpositive, ArctanBelow.
Qed.

(* Inverse sines and cosines of real numbers between -1 and 1 are the real ones. *)
Lemma casin_R : forall x : R, (-1 <= x <= 1)%R -> casin (RtoC x) = RtoC (asin x).
Proof.
  intros x B. unfold casin.
  rewrite <- RtoC_mult, <- RtoC_minus, croot_R by (try lia; nra).
  replace (Ci * RtoC x + RtoC (root 2 (1 - x * x))) with (cexp (Ci * RtoC (asin x))).
  - rewrite cln_cexp; [parts; ring |].
    destruct (asin_bound x) as [B1 B2]. generalize PI_RGT_0. unfold Im. simpl. lra.
  - rewrite C_ExpOfImaginary, ccos_R, csin_R, sin_asin, cos_asin by exact B.
    unfold Rsqr. simpl root. parts; ring.
Qed.

Lemma cacos_R : forall x : R, (-1 <= x <= 1)%R -> cacos (RtoC x) = RtoC (acos x).
Proof. intros x B. unfold cacos. now rewrite casin_R, <- RtoC_minus, acos_as_asin. Qed.
