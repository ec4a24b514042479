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
    end
  | nra
  | enclose ].

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

Ltac equal_values :=
  first
  [ reflexivity
  | ring
  | numerals; integer_powers; first [ring | solve [field; side_condition]] ].

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
