(* Limits at a point, integrals, sums and products of the prover's formulas, over the theorems of VibroAxioms.v. *)

Require Import Reals Lra Lia.
Require Import Coquelicot.Coquelicot.
Require Import VibroAxioms.
Open Scope R_scope.

(* Continuity: a rule for each operation, to be applied one node at a time. *)

Lemma Cont_derive : forall (f : R -> R) (x l : R), is_derive f x l -> continuous f x.
Proof. intros f x l H. exact (ex_derive_continuous f x (ex_intro _ l H)). Qed.

Lemma Cont_chain : forall (F f : R -> R) (x : R), continuous F (f x) -> continuous f x -> continuous (fun t => F (f t)) x.
Proof. intros F f x CF Cf. exact (continuous_comp f F x Cf CF). Qed.

Lemma Cont_const : forall c x : R, continuous (fun _ : R => c) x.
Proof. intros c x. exact (continuous_const c x). Qed.

Lemma Cont_id : forall x : R, continuous (fun t : R => t) x.
Proof. intro x. exact (continuous_id x). Qed.

Lemma Cont_plus : forall (f g : R -> R) (x : R), continuous f x -> continuous g x -> continuous (fun t => f t + g t) x.
Proof. intros f g x F G. exact (continuous_plus f g x F G). Qed.

Lemma Cont_minus : forall (f g : R -> R) (x : R), continuous f x -> continuous g x -> continuous (fun t => f t - g t) x.
Proof. intros f g x F G. exact (continuous_minus f g x F G). Qed.

Lemma Cont_opp : forall (f : R -> R) (x : R), continuous f x -> continuous (fun t => - f t) x.
Proof. intros f x F. exact (continuous_opp f x F). Qed.

Lemma Cont_mult : forall (f g : R -> R) (x : R), continuous f x -> continuous g x -> continuous (fun t => f t * g t) x.
Proof. intros f g x F G. exact (continuous_mult f g x F G). Qed.

Lemma Cont_inv : forall (f : R -> R) (x : R), continuous f x -> f x <> 0 -> continuous (fun t => / f t) x.
Proof.
  intros f x F N. apply (Cont_chain Rinv f); [| exact F].
  apply (Cont_derive _ _ _ (D_inv (fun t => t) (f x) 1 (D_id (f x)) N)).
Qed.

Lemma Cont_div : forall (f g : R -> R) (x : R), continuous f x -> continuous g x -> g x <> 0 ->
  continuous (fun t => f t / g t) x.
Proof. intros f g x F G N. apply (Cont_mult f (fun t => / g t)); [exact F | now apply Cont_inv]. Qed.

Lemma Cont_pow : forall (f : R -> R) (n : nat) (x : R), continuous f x -> continuous (fun t => f t ^ n) x.
Proof.
  intros f n x F. apply (Cont_chain (fun y => y ^ n) f); [| exact F].
  exact (Cont_derive _ _ _ (D_pow (fun t => t) n (f x) 1 (D_id (f x)))).
Qed.

Lemma Cont_powerRZ : forall (f : R -> R) (z : Z) (x : R), continuous f x -> f x <> 0 ->
  continuous (fun t => powerRZ (f t) z) x.
Proof.
  intros f z x F N. apply (Cont_chain (fun y => powerRZ y z) f); [| exact F].
  exact (Cont_derive _ _ _ (D_powerRZ (fun t => t) z (f x) 1 (D_id (f x)) N)).
Qed.

Lemma Cont_sin : forall (f : R -> R) (x : R), continuous f x -> continuous (fun t => sin (f t)) x.
Proof. intros f x F. apply (Cont_chain sin f); [exact (Cont_derive _ _ _ (is_derive_sin (f x))) | exact F]. Qed.

Lemma Cont_cos : forall (f : R -> R) (x : R), continuous f x -> continuous (fun t => cos (f t)) x.
Proof. intros f x F. apply (Cont_chain cos f); [exact (Cont_derive _ _ _ (is_derive_cos (f x))) | exact F]. Qed.

Lemma Cont_tan : forall (f : R -> R) (x : R), continuous f x -> cos (f x) <> 0 -> continuous (fun t => tan (f t)) x.
Proof.
  intros f x F N. apply (Cont_div (fun t => sin (f t)) (fun t => cos (f t))); [now apply Cont_sin | now apply Cont_cos | exact N].
Qed.

Lemma Cont_exp : forall (f : R -> R) (x : R), continuous f x -> continuous (fun t => exp (f t)) x.
Proof. intros f x F. apply (Cont_chain exp f); [exact (Cont_derive _ _ _ (is_derive_exp (f x))) | exact F]. Qed.

Lemma Cont_ln : forall (f : R -> R) (x : R), continuous f x -> 0 < f x -> continuous (fun t => ln (f t)) x.
Proof. intros f x F P. apply (Cont_chain ln f); [exact (Cont_derive _ _ _ (is_derive_ln (f x) P)) | exact F]. Qed.

Lemma Cont_sqrt : forall (f : R -> R) (x : R), continuous f x -> continuous (fun t => sqrt (f t)) x.
Proof. intros f x F. apply (Cont_chain sqrt f); [apply continuous_sqrt | exact F]. Qed.

Lemma Cont_Rabs : forall (f : R -> R) (x : R), continuous f x -> continuous (fun t => Rabs (f t)) x.
Proof. intros f x F. apply (Cont_chain Rabs f); [apply continuous_Rabs | exact F]. Qed.

Lemma Cont_atan : forall (f : R -> R) (x : R), continuous f x -> continuous (fun t => atan (f t)) x.
Proof. intros f x F. apply (Cont_chain atan f); [exact (Cont_derive _ _ _ (is_derive_atan (f x))) | exact F]. Qed.

Lemma Cont_near : forall (f g : R -> R) (x : R), locally x (fun t => f t = g t) -> continuous f x -> continuous g x.
Proof. intros f g x E F. apply (continuous_ext_loc g f x); assumption. Qed.

(* Values held between two ends. *)

Ltac by_cases :=
  repeat match goal with
  | |- context [Rle_dec ?x ?y] =>
    lazymatch y with
    | context [Rle_dec _ _] => fail
    | _ => destruct (Rle_dec x y)
    end
  | |- context [Rcase_abs ?x] =>
    lazymatch x with
    | context [Rle_dec _ _] => fail
    | _ => destruct (Rcase_abs x)
    end
  end;
  lra.

Definition clamp (a b t : R) : R := Rmax a (Rmin b t).

Lemma clamp_in : forall a b t : R, a <= b -> a <= clamp a b t <= b.
Proof. intros a b t H. unfold clamp, Rmax, Rmin. by_cases. Qed.

Lemma clamp_id : forall a b t : R, a <= t <= b -> clamp a b t = t.
Proof. intros a b t H. unfold clamp, Rmax, Rmin. by_cases. Qed.

Lemma clamp_contracts : forall a b s t : R, a <= b -> Rabs (clamp a b t - clamp a b s) <= Rabs (t - s).
Proof.
  intros a b s t H. unfold clamp, Rmax, Rmin, Rabs. by_cases.
Qed.

Lemma clamp_limit : forall a b x : R, a <= b ->
  filterlim (clamp a b) (locally x) (within (fun t => a <= t <= b) (locally (clamp a b x))).
Proof.
  intros a b x H P [eps HP]. exists eps. intros y B. apply HP; [| now apply clamp_in].
  apply Rle_lt_trans with (2 := B). now apply clamp_contracts.
Qed.

Lemma Cont_clamp : forall (a b : R) (f : R -> R) (x : R), a <= b -> continuous_on (fun t => a <= t <= b) f ->
  continuous (fun t => f (clamp a b t)) x.
Proof.
  intros a b f x H C. unfold continuous.
  apply (filterlim_comp _ _ _ (clamp a b) f (locally x) _ _ (clamp_limit a b x H)).
  apply C. now apply clamp_in.
Qed.

Lemma Cont_everywhere : forall (f : R -> R) (a b x : R), a <= b ->
  (forall t, a <= t <= b -> continuous f t) -> continuous (fun t => f (clamp a b t)) x.
Proof.
  intros f a b x H C. apply Cont_clamp; [exact H |]. apply continuous_on_forall. exact C.
Qed.

(* Inverse sines and cosines are continuous at the ends too. *)

Lemma asin_half : forall x : R, -1 <= x <= 1 -> asin x = 2 * atan (x / (1 + sqrt (1 - x * x))).
Proof.
  intros x H. destruct (asin_bound x) as [B1 B2]. generalize PI_RGT_0. intro P.
  generalize (sin_asin x H) (cos_asin x H). intros S K. unfold Rsqr in K.
  assert (C : 0 < cos (asin x / 2)) by (apply cos_gt_0; lra).
  replace (x / (1 + sqrt (1 - x * x))) with (tan (asin x / 2)).
  - rewrite atan_tan by lra. field.
  - transitivity (sin (asin x) / (1 + cos (asin x))); [| now rewrite S, K].
    replace (asin x) with (2 * (asin x / 2)) at 2 3 by field.
    rewrite cos_2a_cos, sin_2a. unfold tan. field. split; [nra | lra].
Qed.

Lemma asin_clamp : forall x : R, asin x = asin (clamp (-1) 1 x).
Proof.
  intro x. destruct (Rlt_dec x (-1)) as [L | L]; [| destruct (Rlt_dec 1 x) as [G | G]].
  - replace (clamp (-1) 1 x) with (-1).
    + unfold asin. destruct (Rle_dec x (-1)); [| lra]. destruct (Rle_dec (-1) (-1)); [reflexivity | lra].
    + unfold clamp, Rmax, Rmin. by_cases.
  - replace (clamp (-1) 1 x) with 1.
    + unfold asin. destruct (Rle_dec x (-1)); [lra |]. destruct (Rle_dec 1 x); [| lra].
      destruct (Rle_dec 1 (-1)); [lra |]. destruct (Rle_dec 1 1); [reflexivity | lra].
    + unfold clamp, Rmax, Rmin. by_cases.
  - rewrite clamp_id; [reflexivity | lra].
Qed.

Lemma continuous_asin : forall x : R, continuous asin x.
Proof.
  intro x.
  apply (continuous_ext (fun t => 2 * atan (clamp (-1) 1 t / (1 + sqrt (1 - clamp (-1) 1 t * clamp (-1) 1 t))))).
  { intro t. rewrite (asin_clamp t). symmetry. apply asin_half. apply clamp_in. lra. }
  apply (Cont_everywhere (fun t => 2 * atan (t / (1 + sqrt (1 - t * t))))); [lra |].
  intros t _. apply Cont_mult; [apply Cont_const |]. apply Cont_atan, Cont_div; [apply Cont_id | |].
  - apply Cont_plus; [apply Cont_const |].
    apply Cont_sqrt, Cont_minus; [apply Cont_const | apply Cont_mult; apply Cont_id].
  - generalize (sqrt_pos (1 - t * t)). lra.
Qed.

Lemma Cont_asin : forall (f : R -> R) (x : R), continuous f x -> continuous (fun t => asin (f t)) x.
Proof. intros f x F. apply (Cont_chain asin f); [apply continuous_asin | exact F]. Qed.

Lemma Cont_acos : forall (f : R -> R) (x : R), continuous f x -> continuous (fun t => acos (f t)) x.
Proof.
  intros f x F. apply (continuous_ext (fun t => PI / 2 - asin (f t))).
  { intro t. symmetry. apply acos_as_asin. }
  apply Cont_minus; [apply Cont_const | now apply Cont_asin].
Qed.

(* Roots and powers. *)

Lemma root_bound : forall (n : nat) (x : R), (1 <= n)%nat -> Rabs (root n x) <= root n (Rabs x).
Proof.
  intros n x N. destruct (Rle_dec 0 x) as [P | P].
  - rewrite (Rabs_pos_eq x P), (Rabs_pos_eq _ (root_ge_0 n x P)). lra.
  - assert (Q : 0 < Rabs x) by (apply Rabs_pos_lt; lra).
    destruct n as [| [| [| n]]]; unfold root.
    + lia.
    + destruct (Rlt_dec 0 x); [lra |]. destruct (Rlt_dec x 0); [| lra].
      destruct (Rlt_dec 0 (Rabs x)); [| lra].
      rewrite Rabs_Ropp, (Rabs_left x) by lra. right. apply Rabs_pos_eq. left. apply exp_pos.
    + rewrite sqrt_neg_0 by lra. rewrite Rabs_R0. apply sqrt_pos.
    + destruct (Rlt_dec 0 x); [lra |]. destruct (Rlt_dec x 0); [| lra].
      destruct (Rlt_dec 0 (Rabs x)); [| lra].
      rewrite Rabs_Ropp, (Rabs_left x) by lra. right. apply Rabs_pos_eq. left. apply exp_pos.
Qed.

Lemma root_lt : forall (n : nat) (x y : R), (1 <= n)%nat -> 0 <= x -> 0 < y -> x < y ^ n -> root n x < y.
Proof.
  intros n x y N X Y H.
  destruct (Rlt_dec (root n x) y) as [L | L]; [exact L |].
  exfalso. apply (Rlt_irrefl x). apply (Rlt_le_trans _ _ _ H).
  rewrite <- (root_pow n x N X). apply pow_incr. lra.
Qed.

Lemma continuous_root_0 : forall n : nat, (1 <= n)%nat -> continuous (root n) 0.
Proof.
  intros n N. apply continuity_pt_filterlim. apply continuity_pt_locally. intro eps.
  exists (mkposreal (eps ^ n) (pow_lt _ _ (cond_pos eps))). intros y B.
  rewrite root_0, Rminus_0_r.
  apply Rle_lt_trans with (1 := root_bound n y N).
  apply root_lt; [exact N | apply Rabs_pos | apply cond_pos |].
  unfold ball in B. simpl in B. unfold AbsRing_ball, abs, minus, plus, opp in B. simpl in B.
  rewrite Ropp_0, Rplus_0_r in B. exact B.
Qed.

Lemma Cont_root : forall (n : nat) (f : R -> R) (x : R), continuous f x -> (1 <= n)%nat -> 0 <= f x ->
  continuous (fun t => root n (f t)) x.
Proof.
  intros n f x F N [P | Z].
  - apply (Cont_chain (root n) f); [| exact F]. exact (Cont_derive _ _ _ (is_derive_root n (f x) N P)).
  - apply (Cont_chain (root n) f); [| exact F]. rewrite <- Z. now apply continuous_root_0.
Qed.

Lemma Cont_root_odd : forall (n : nat) (f : R -> R) (x : R), continuous f x -> Nat.odd n = true ->
  continuous (fun t => root n (f t)) x.
Proof.
  intros n f x F O. apply (Cont_chain (root n) f); [| exact F].
  assert (N : (1 <= n)%nat) by (destruct n; [discriminate O | lia]).
  destruct (Req_dec (f x) 0) as [-> | E]; [now apply continuous_root_0 |].
  exact (Cont_derive _ _ _ (D_root_odd n (fun t => t) (f x) 1 (D_id (f x)) O E)).
Qed.

Lemma near_positive_continuous : forall (f : R -> R) (x : R), continuous f x -> 0 < f x -> locally x (fun t => 0 < f t).
Proof. intros f x C P. exact (C (fun y => 0 < y) (open_gt 0 (f x) P)). Qed.

Lemma Cont_rpow : forall (f g : R -> R) (x : R), continuous f x -> continuous g x -> 0 < f x ->
  continuous (fun t => rpow (f t) (g t)) x.
Proof.
  intros f g x F G P.
  apply (Cont_near (fun t => exp (g t * ln (f t)))).
  { generalize (near_positive_continuous f x F P). apply filter_imp. intros t T. symmetry. now apply rpow_pos. }
  apply Cont_exp, Cont_mult; [exact G | now apply Cont_ln].
Qed.

Lemma Cont_rpow_nat : forall (z : Z) (n : nat) (f : R -> R) (x : R), Z.of_nat n = z -> continuous f x ->
  continuous (fun t => rpow (f t) (IZR z)) x.
Proof.
  intros z n f x <- F. apply (continuous_ext (fun t => f t ^ n)); [| now apply Cont_pow].
  intro t. now rewrite <- INR_IZR_INZ, rpow_INR.
Qed.

Lemma Cont_rpow_IZR : forall (z : Z) (f : R -> R) (x : R), continuous f x -> f x <> 0 ->
  continuous (fun t => rpow (f t) (IZR z)) x.
Proof.
  intros z f x F N. apply (continuous_ext (fun t => powerRZ (f t) z)); [| now apply Cont_powerRZ].
  intro t. symmetry. apply rpow_IZR.
Qed.

Lemma Cont_rpow_INR : forall (n : nat) (f : R -> R) (x : R), continuous f x -> continuous (fun t => rpow (f t) (INR n)) x.
Proof.
  intros n f x F. apply (continuous_ext (fun t => f t ^ n)); [| now apply Cont_pow].
  intro t. symmetry. apply rpow_INR.
Qed.

Lemma rpow_bound : forall x c : R, 0 < c -> x <> 0 -> Rabs (rpow x c) <= rpow (Rabs x) c.
Proof.
  intros x c H N. assert (P : 0 < Rabs x) by now apply Rabs_pos_lt.
  destruct (Rlt_dec 0 x) as [X | X].
  - rewrite (Rabs_pos_eq x) by lra. right. apply Rabs_pos_eq. left. now apply rpow_positive.
  - unfold rpow at 1. destruct (Rlt_dec 0 x) as [F | _]; [contradiction |].
    destruct (Req_EM_T c (IZR (Int_part c))) as [E | E].
    + rewrite E at 2. rewrite rpow_IZR. rewrite E in H. apply lt_IZR in H.
      rewrite <- (Z2Nat.id (Int_part c)) by lia. rewrite <- !pow_powerRZ, RPow_abs. lra.
    + rewrite Rabs_R0. left. now apply rpow_positive.
Qed.

Lemma continuous_rpow_0 : forall c : R, 0 < c -> continuous (fun t => rpow t c) 0.
Proof.
  intros c H. apply continuity_pt_filterlim, continuity_pt_locally. intro eps.
  assert (D : 0 < rpow eps (/ c)) by apply rpow_positive, cond_pos.
  exists (mkposreal _ D). intros y B.
  unfold ball in B. simpl in B. unfold AbsRing_ball, abs, minus, plus, opp in B. simpl in B.
  rewrite Ropp_0, Rplus_0_r in B.
  rewrite (rpow_zero 0 c eq_refl H), Rminus_0_r.
  destruct (Req_dec y 0) as [-> | N].
  - rewrite (rpow_zero 0 c eq_refl H), Rabs_R0. apply cond_pos.
  - apply Rle_lt_trans with (1 := rpow_bound y c H N).
    assert (P : 0 < Rabs y) by now apply Rabs_pos_lt.
    rewrite rpow_pos in B |- * by (try exact P; apply cond_pos).
    apply ln_increasing in B; [| exact P]. rewrite ln_exp in B.
    rewrite <- (exp_ln eps (cond_pos eps)). apply exp_increasing.
    apply (Rmult_lt_compat_l c) in B; [| exact H].
    replace (c * (/ c * ln eps)) with (ln eps) in B by (field; lra). exact B.
Qed.

Lemma Cont_rpow_const : forall (c : R) (f : R -> R) (x : R), continuous f x -> 0 < c -> 0 <= f x ->
  continuous (fun t => rpow (f t) c) x.
Proof.
  intros c f x F H [P | Z].
  - apply (Cont_rpow f (fun _ => c)); [exact F | apply Cont_const | exact P].
  - apply (Cont_chain (fun y => rpow y c) f); [| exact F]. rewrite <- Z. now apply continuous_rpow_0.
Qed.

(* Continuity by the rules; what is left are side conditions. *)

Ltac continuous_node :=
  lazymatch goal with
  | |- continuous (fun _ => ?c) ?x => exact (Cont_const c x)
  | |- continuous (fun t => t) ?x => exact (Cont_id x)
  | |- continuous (fun t => @?f t + @?g t) ?x => refine (Cont_plus f g x _ _)
  | |- continuous (fun t => @?f t - @?g t) ?x => refine (Cont_minus f g x _ _)
  | |- continuous (fun t => - @?f t) ?x => refine (Cont_opp f x _)
  | |- continuous (fun t => @?f t * @?g t) ?x => refine (Cont_mult f g x _ _)
  | |- continuous (fun t => @?f t / @?g t) ?x => refine (Cont_div f g x _ _ _)
  | |- continuous (fun t => / @?f t) ?x => refine (Cont_inv f x _ _)
  | |- continuous (fun t => @?f t ^ ?n) ?x => refine (Cont_pow f n x _)
  | |- continuous (fun t => powerRZ (@?f t) ?z) ?x => refine (Cont_powerRZ f z x _ _)
  | |- continuous (fun t => sin (@?f t)) ?x => refine (Cont_sin f x _)
  | |- continuous (fun t => cos (@?f t)) ?x => refine (Cont_cos f x _)
  | |- continuous (fun t => tan (@?f t)) ?x => refine (Cont_tan f x _ _)
  | |- continuous (fun t => exp (@?f t)) ?x => refine (Cont_exp f x _)
  | |- continuous (fun t => ln (@?f t)) ?x => refine (Cont_ln f x _ _)
  | |- continuous (fun t => sqrt (@?f t)) ?x => refine (Cont_sqrt f x _)
  | |- continuous (fun t => Rabs (@?f t)) ?x => refine (Cont_Rabs f x _)
  | |- continuous (fun t => root 2 (@?f t)) ?x => refine (Cont_sqrt f x _)
  | |- continuous (fun t => root ?n (@?f t)) ?x =>
    first
    [ refine (Cont_root_odd n f x _ (eq_refl true))
    | refine (Cont_root n f x _ _ _); [| lia |] ]
  | |- continuous (fun t => rpow (@?f t) (@?g t)) ?x =>
    lazymatch g with
    | fun _ => IZR ?z =>
      lazymatch z with
      | Zneg _ => refine (Cont_rpow_IZR z f x _ _)
      | _ => let n := eval compute in (Z.to_nat z) in refine (Cont_rpow_nat z n f x (eq_refl z) _)
      end
    | fun _ => INR ?n => refine (Cont_rpow_INR n f x _)
    | fun _ => ?c =>
      first
      [ let H := fresh in
        assert (H : 0 < c) by side_condition; refine (Cont_rpow_const c f x _ H _); clear H
      | refine (Cont_rpow f g x _ _ _) ]
    | _ => refine (Cont_rpow f g x _ _ _)
    end
  | |- continuous (fun t => atan (@?f t)) ?x => refine (Cont_atan f x _)
  | |- continuous (fun t => asin (@?f t)) ?x => refine (Cont_asin f x _)
  | |- continuous (fun t => acos (@?f t)) ?x => refine (Cont_acos f x _)
  | |- continuous (fun t => _) _ => assumption
  | |- continuous ?f ?x => first [assumption | progress change (continuous (fun t => f t) x)]
  end.

Ltac is_continuous :=
  repeat lazymatch goal with |- continuous _ _ => continuous_node end; try side_condition.

Example is_continuous_1 : forall x : R, 0 < x ->
  continuous (fun t => root 3 (sin t) + ln t / t + rpow t t + rpow t 2 * rpow t (-2) + asin t + sqrt (1 - t)) x.
Proof. intros x H. is_continuous. Qed.

Example is_continuous_2 : continuous (fun t => rpow t (3 / 2) + root 4 t + rpow (t + 1) (-1 / 2)) 0.
Proof. is_continuous. Qed.

(* Limits at a point of functions that are continuous there. *)

Lemma limit_continuous : forall (f : R -> R) (x : R), continuous f x -> is_lim f x (f x).
Proof. intros f x C. apply is_lim_continuity, continuity_pt_filterlim, C. Qed.

Lemma limit_value : forall (f : R -> R) (x l : R), continuous f x -> f x = l -> is_lim f x l.
Proof. intros f x l C <-. now apply limit_continuous. Qed.

(* A function that agrees with a continuous one near a point, the point itself left out. *)
Lemma limit_removable : forall (f g : R -> R) (x l : R), continuous g x -> g x = l ->
  (forall t : R, t <> x -> f t = g t) -> is_lim f x l.
Proof.
  intros f g x l C E H. apply (is_lim_ext_loc g).
  - exists (mkposreal 1 Rlt_0_1). intros t _ N. symmetry. now apply H.
  - now apply limit_value.
Qed.

Lemma limit_removable_near : forall (f g : R -> R) (x l d : R), continuous g x -> g x = l -> 0 < d ->
  (forall t : R, t <> x -> Rabs (t - x) < d -> f t = g t) -> is_lim f x l.
Proof.
  intros f g x l d C E D H. apply (is_lim_ext_loc g).
  - exists (mkposreal d D). intros t B N. symmetry. now apply H.
  - now apply limit_value.
Qed.

Lemma limit_derivative : forall (f : R -> R) (x l : R), is_derive f x l ->
  is_lim (fun h => (f (x + h) - f x) / h) 0 l.
Proof.
  intros f x l H. apply is_derive_Reals in H. apply is_lim_spec. intro eps.
  destruct (H eps (cond_pos eps)) as [d D]. exists d. intros h B N. apply D; [exact N |].
  unfold ball in B. simpl in B. unfold AbsRing_ball, abs, minus, plus, opp in B. simpl in B.
  now rewrite Ropp_0, Rplus_0_r in B.
Qed.

Lemma limit_unique : forall (f : R -> R) (x : Rbar) (l m : Rbar), is_lim f x l -> is_lim f x m -> l = m.
Proof.
  intros f x l m L M. rewrite <- (is_lim_unique f x l L). now apply is_lim_unique.
Qed.

Lemma limit_plus : forall (f g : R -> R) (x : Rbar) (l m : R), is_lim f x l -> is_lim g x m ->
  is_lim (fun t => f t + g t) x (l + m).
Proof. intros f g x l m F G. now apply (is_lim_plus' f g x l m). Qed.

Lemma limit_minus : forall (f g : R -> R) (x : Rbar) (l m : R), is_lim f x l -> is_lim g x m ->
  is_lim (fun t => f t - g t) x (l - m).
Proof. intros f g x l m F G. now apply (is_lim_minus' f g x l m). Qed.

Lemma limit_mult : forall (f g : R -> R) (x : Rbar) (l m : R), is_lim f x l -> is_lim g x m ->
  is_lim (fun t => f t * g t) x (l * m).
Proof. intros f g x l m F G. exact (is_lim_mult f g x l m F G I). Qed.

Lemma limit_div : forall (f g : R -> R) (x : Rbar) (l m : R), is_lim f x l -> is_lim g x m -> m <> 0 ->
  is_lim (fun t => f t / g t) x (l / m).
Proof.
  intros f g x l m F G N. apply limit_mult; [exact F |].
  apply (is_lim_inv g x m G). intro E. apply N. now injection E.
Qed.

Lemma limit_comp : forall (F f : R -> R) (x : Rbar) (l : R), is_lim f x l -> continuous F l ->
  is_lim (fun t => F (f t)) x (F l).
Proof. intros F f x l H C. now apply (is_lim_comp_continuous f F). Qed.

Lemma limit_atan_p : is_lim atan p_infty (PI / 2).
Proof.
  apply is_lim_spec. intro eps. generalize PI_RGT_0 (cond_pos eps). intros P E.
  set (d := Rmin eps (PI / 4)).
  assert (D : 0 < d /\ d <= eps /\ d <= PI / 4).
  { unfold d. split; [apply Rmin_pos; lra | split; [apply Rmin_l | apply Rmin_r]]. }
  exists (tan (PI / 2 - d)). intros y Y.
  apply atan_increasing in Y. rewrite atan_tan in Y by lra.
  destruct (atan_bound y) as [_ B]. rewrite Rabs_left by lra. lra.
Qed.

Lemma limit_atan_m : is_lim atan m_infty (- (PI / 2)).
Proof.
  apply (is_lim_ext (fun t => - atan (- t))).
  { intro t. rewrite atan_opp. ring. }
  apply (is_lim_opp (fun t => atan (- t)) m_infty (PI / 2)).
  apply (is_lim_comp atan (fun t => - t) m_infty (PI / 2) p_infty).
  - exact limit_atan_p.
  - apply (is_lim_opp (fun t => t) m_infty m_infty). apply is_lim_id.
  - exists 0. discriminate.
Qed.

Example limit_1 : is_lim (fun t => (t ^ 2 - 1) / (t - 1)) 1 2.
Proof. apply (limit_removable _ (fun t => t + 1)); [is_continuous | lra | intros t N; field; lra]. Qed.

(* Integrals by antiderivatives, with ends in any order. *)

Lemma integral_closed : forall (F f : R -> R) (a b : R),
  (forall x, Rmin a b <= x <= Rmax a b -> is_derive F x (f x)) ->
  (forall x, Rmin a b <= x <= Rmax a b -> continuous f x) ->
  is_RInt f a b (F b - F a).
Proof. intros F f a b D C. exact (is_RInt_derive F f a b D C). Qed.

Lemma RInt_closed : forall (F f : R -> R) (a b : R),
  (forall x, Rmin a b <= x <= Rmax a b -> is_derive F x (f x)) ->
  (forall x, Rmin a b <= x <= Rmax a b -> continuous f x) ->
  RInt f a b = F b - F a :> R.
Proof. intros F f a b D C. apply is_RInt_unique. now apply integral_closed. Qed.

(* The antiderivative may lack a derivative at the ends; continuity there is of values between the ends alone. *)
Lemma integral_within : forall (F f : R -> R) (a b : R),
  continuous_on (fun t => Rmin a b <= t <= Rmax a b) F ->
  continuous_on (fun t => Rmin a b <= t <= Rmax a b) f ->
  (forall x, Rmin a b < x < Rmax a b -> is_derive F x (f x)) ->
  is_RInt f a b (F b - F a).
Proof.
  intros F f a b CF Cf D.
  assert (M : Rmin a b <= Rmax a b) by apply Rmin_Rmax.
  set (lo := Rmin a b) in *. set (hi := Rmax a b) in *.
  set (g := fun t => f (clamp lo hi t)).
  assert (Cg : forall x, continuous g x) by (intro x; now apply Cont_clamp).
  assert (X : forall y, ex_RInt g a y) by (intro y; apply (ex_RInt_continuous (V := R_CompleteNormedModule)); intros; apply Cg).
  assert (DG : forall y, is_derive (fun t => RInt g a t) y (g y)).
  { intro y. apply (is_derive_RInt g (fun t => RInt g a t) a y); [| apply Cg].
    apply filter_forall. intro t. exact (RInt_correct g a t (X t)). }
  set (H := fun t => F (clamp lo hi t) - RInt g a t).
  assert (E : H b - H a = 0).
  { destruct (MVT_gen H a b (fun _ => 0)) as [c [_ E]]; fold lo hi.
    - intros x B. unfold H. eapply D_equal; [apply D_minus; [| apply DG] |].
      + apply (D_near F); [| apply (D x B)].
        assert (N : 0 < Rmin (x - lo) (hi - x)) by (apply Rmin_pos; lra).
        exists (mkposreal _ N). intros t T. unfold ball in T. simpl in T.
        unfold AbsRing_ball, abs, minus, plus, opp in T. simpl in T.
        apply Rabs_def2 in T. generalize (Rmin_l (x - lo) (hi - x)) (Rmin_r (x - lo) (hi - x)). intros.
        rewrite clamp_id; [reflexivity | lra].
      + unfold g. rewrite clamp_id by lra. ring.
    - intros x _. apply continuity_pt_filterlim. unfold H.
      apply (Cont_minus (fun t => F (clamp lo hi t)) (fun t => RInt g a t)); [now apply Cont_clamp |].
      exact (Cont_derive _ _ _ (DG x)).
    - rewrite E. ring. }
  assert (A : lo <= a <= hi) by (unfold lo, hi; split; [apply Rmin_l | apply Rmax_l]).
  assert (B : lo <= b <= hi) by (unfold lo, hi; split; [apply Rmin_r | apply Rmax_r]).
  unfold H in E. rewrite !clamp_id in E by assumption.
  rewrite (RInt_point a g) in E. unfold zero in E. simpl in E.
  replace (F b - F a) with (RInt g a b) by lra.
  apply (is_RInt_ext g); [| exact (RInt_correct g a b (X b))].
  intros t T. unfold g. fold lo hi in T. rewrite clamp_id; [reflexivity | lra].
Qed.

Lemma integral_open : forall (F f : R -> R) (a b : R),
  (forall x, Rmin a b <= x <= Rmax a b -> continuous F x) ->
  (forall x, Rmin a b <= x <= Rmax a b -> continuous f x) ->
  (forall x, Rmin a b < x < Rmax a b -> is_derive F x (f x)) ->
  is_RInt f a b (F b - F a).
Proof.
  intros F f a b CF Cf D. apply integral_within; [| | exact D]; apply continuous_on_forall; assumption.
Qed.

Lemma RInt_open : forall (F f : R -> R) (a b : R),
  (forall x, Rmin a b <= x <= Rmax a b -> continuous F x) ->
  (forall x, Rmin a b <= x <= Rmax a b -> continuous f x) ->
  (forall x, Rmin a b < x < Rmax a b -> is_derive F x (f x)) ->
  RInt f a b = F b - F a :> R.
Proof. intros F f a b CF Cf D. apply is_RInt_unique. now apply integral_open. Qed.

(* Between ends in order the conditions are written without minimum and maximum. *)
Lemma integral_from_to : forall (F f : R -> R) (a b : R), a <= b ->
  (forall x, a <= x <= b -> continuous F x) ->
  (forall x, a <= x <= b -> continuous f x) ->
  (forall x, a < x < b -> is_derive F x (f x)) ->
  is_RInt f a b (F b - F a).
Proof.
  intros F f a b H CF Cf D.
  apply integral_open; rewrite (Rmin_left a b H), (Rmax_right a b H); assumption.
Qed.

Lemma RInt_from_to : forall (F f : R -> R) (a b : R), a <= b ->
  (forall x, a <= x <= b -> continuous F x) ->
  (forall x, a <= x <= b -> continuous f x) ->
  (forall x, a < x < b -> is_derive F x (f x)) ->
  RInt f a b = F b - F a :> R.
Proof. intros F f a b H CF Cf D. apply is_RInt_unique. now apply integral_from_to. Qed.

Lemma RInt_from_to_value : forall (F f : R -> R) (a b v : R), a <= b ->
  (forall x, a <= x <= b -> continuous F x) ->
  (forall x, a <= x <= b -> continuous f x) ->
  (forall x, a < x < b -> is_derive F x (f x)) ->
  F b - F a = v ->
  RInt f a b = v :> R.
Proof. intros F f a b v H CF Cf D <-. now apply RInt_from_to. Qed.

Lemma RInt_down_value : forall (F f : R -> R) (a b v : R), b <= a ->
  (forall x, b <= x <= a -> continuous F x) ->
  (forall x, b <= x <= a -> continuous f x) ->
  (forall x, b < x < a -> is_derive F x (f x)) ->
  F b - F a = v ->
  RInt f a b = v :> R.
Proof.
  intros F f a b v H CF Cf D <-. apply RInt_open; rewrite (Rmin_right a b H), (Rmax_left a b H); assumption.
Qed.

Lemma RInt_any_value : forall (F f : R -> R) (a b v : R),
  (forall x, Rmin a b <= x <= Rmax a b -> continuous F x) ->
  (forall x, Rmin a b <= x <= Rmax a b -> continuous f x) ->
  (forall x, Rmin a b < x < Rmax a b -> is_derive F x (f x)) ->
  F b - F a = v ->
  RInt f a b = v :> R.
Proof. intros F f a b v CF Cf D <-. now apply RInt_open. Qed.

(* The value of an integral by a given antiderivative; what is left are conditions that were not proved, and the value. *)
Ltac integrate F :=
  lazymatch goal with
  | |- RInt ?f ?a ?b = ?v =>
    first
    [ let H := fresh in
      assert (H : a <= b) by side_condition; refine (RInt_from_to_value F f a b v H _ _ _ _); clear H
    | let H := fresh in
      assert (H : b <= a) by side_condition; refine (RInt_down_value F f a b v H _ _ _ _); clear H
    | refine (RInt_any_value F f a b v _ _ _ _) ]
  end;
  [ intros; is_continuous | intros; is_continuous | intros; differentiate | cbv beta ].

(* Integrals that are equal, added, scaled and put together. *)

Lemma integral_equal : forall (f g : R -> R) (a b : R),
  (forall x, Rmin a b < x < Rmax a b -> f x = g x) -> RInt f a b = RInt g a b :> R.
Proof. intros f g a b E. exact (RInt_ext f g a b E). Qed.

Lemma integrable : forall (f : R -> R) (a b : R), (forall x, Rmin a b <= x <= Rmax a b -> continuous f x) -> ex_RInt f a b.
Proof. intros f a b C. exact (ex_RInt_continuous (V := R_CompleteNormedModule) f a b C). Qed.

Lemma integral_plus : forall (f g : R -> R) (a b : R), ex_RInt f a b -> ex_RInt g a b ->
  RInt (fun t => f t + g t) a b = RInt f a b + RInt g a b :> R.
Proof. intros f g a b F G. exact (RInt_plus f g a b F G). Qed.

Lemma integral_minus : forall (f g : R -> R) (a b : R), ex_RInt f a b -> ex_RInt g a b ->
  RInt (fun t => f t - g t) a b = RInt f a b - RInt g a b :> R.
Proof. intros f g a b F G. exact (RInt_minus f g a b F G). Qed.

Lemma integral_scal : forall (c : R) (f : R -> R) (a b : R), ex_RInt f a b ->
  RInt (fun t => c * f t) a b = c * RInt f a b :> R.
Proof. intros c f a b F. exact (RInt_scal f a b c F). Qed.

Lemma integral_chasles : forall (f : R -> R) (a b c : R), ex_RInt f a b -> ex_RInt f b c ->
  RInt f a b + RInt f b c = RInt f a c :> R.
Proof. intros f a b c F G. exact (RInt_Chasles f a b c F G). Qed.

Lemma integral_point : forall (f : R -> R) (a : R), RInt f a a = 0 :> R.
Proof. intros f a. exact (RInt_point a f). Qed.

(* Improper integrals are differences of limits of the antiderivative. *)

Lemma integral_between : forall (F f : R -> R) (Fa Fb : (R -> Prop) -> Prop) (la lb : R),
  Filter Fa -> Filter Fb ->
  filter_prod Fa Fb (fun ab => forall x, Rmin (fst ab) (snd ab) <= x <= Rmax (fst ab) (snd ab) ->
    is_derive F x (f x) /\ continuous f x) ->
  filterlim F Fa (locally la) -> filterlim F Fb (locally lb) ->
  is_RInt_gen f Fa Fb (lb - la).
Proof.
  intros F f Fa Fb la lb FFa FFb D LA LB P HP.
  assert (G : filterlim (fun ab : R * R => F (snd ab) - F (fst ab)) (filter_prod Fa Fb) (locally (lb - la))).
  { refine (filterlim_comp_2 (G := locally lb) (H := locally (opp la))
      (fun ab : R * R => F (snd ab)) (fun ab : R * R => opp (F (fst ab))) plus _ _ _).
    - exact (filterlim_comp _ _ _ snd F _ _ _ filterlim_snd LB).
    - apply (filterlim_comp _ _ _ (fun ab : R * R => F (fst ab)) opp _ (locally la)).
      + exact (filterlim_comp _ _ _ fst F _ _ _ filterlim_fst LA).
      + exact (filterlim_opp (V := R_NormedModule) la).
    - exact (filterlim_plus (V := R_NormedModule) lb (opp la)). }
  specialize (G P HP). unfold filtermap in G. unfold filtermapi.
  generalize (filter_and _ _ D G). apply filter_imp. intros [x y] [H K]. simpl in *.
  exists (F y - F x). split; [| exact K].
  apply integral_closed; intros t T; now apply H.
Qed.

Lemma integral_to_infinity : forall (F f : R -> R) (a l : R),
  (forall x, a <= x -> is_derive F x (f x)) -> (forall x, a <= x -> continuous f x) -> is_lim F p_infty l ->
  is_RInt_gen f (at_point a) (Rbar_locally p_infty) (l - F a).
Proof.
  intros F f a l D C L. apply (integral_between F); [apply at_point_filter | apply Rbar_locally_filter | | | exact L].
  - apply (Filter_prod _ _ _ (fun x => x = a) (fun y => a < y)); [reflexivity | now exists a |].
    intros x y -> Y t T. simpl in *. rewrite Rmin_left in T by lra. split; [apply D | apply C]; lra.
  - intros P HP. exact (locally_singleton _ _ HP).
Qed.

Lemma integral_from_infinity : forall (F f : R -> R) (b l : R),
  (forall x, x <= b -> is_derive F x (f x)) -> (forall x, x <= b -> continuous f x) -> is_lim F m_infty l ->
  is_RInt_gen f (Rbar_locally m_infty) (at_point b) (F b - l).
Proof.
  intros F f b l D C L. apply (integral_between F); [apply Rbar_locally_filter | apply at_point_filter | | exact L |].
  - apply (Filter_prod _ _ _ (fun x => x < b) (fun y => y = b)); [now exists b | reflexivity |].
    intros x y X -> t T. simpl in *. rewrite Rmax_right in T by lra. split; [apply D | apply C]; lra.
  - intros P HP. exact (locally_singleton _ _ HP).
Qed.

Lemma integral_whole_line : forall (F f : R -> R) (l m : R),
  (forall x, is_derive F x (f x)) -> (forall x, continuous f x) -> is_lim F m_infty l -> is_lim F p_infty m ->
  is_RInt_gen f (Rbar_locally m_infty) (Rbar_locally p_infty) (m - l).
Proof.
  intros F f l m D C L M. apply (integral_between F); [apply Rbar_locally_filter | apply Rbar_locally_filter | | exact L | exact M].
  apply filter_forall. intros ab t _. now split.
Qed.

Lemma integral_from_right : forall (F f : R -> R) (a b l : R), a < b ->
  (forall x, a < x <= b -> is_derive F x (f x)) -> (forall x, a < x <= b -> continuous f x) ->
  filterlim F (at_right a) (locally l) ->
  is_RInt_gen f (at_right a) (at_point b) (F b - l).
Proof.
  intros F f a b l H D C L. apply (integral_between F); [apply at_right_proper_filter | apply at_point_filter | | exact L |].
  - apply (Filter_prod _ _ _ (fun x => a < x < b) (fun y => y = b)); [| reflexivity |].
    + assert (N : 0 < b - a) by lra. exists (mkposreal _ N). intros y B Y.
      unfold ball in B. simpl in B. unfold AbsRing_ball, abs, minus, plus, opp in B. simpl in B.
      apply Rabs_def2 in B. lra.
    + intros x y X -> t T. simpl in *. rewrite Rmin_left, Rmax_right in T by lra. split; [apply D | apply C]; lra.
  - intros P HP. exact (locally_singleton _ _ HP).
Qed.

Lemma integral_to_left : forall (F f : R -> R) (a b l : R), a < b ->
  (forall x, a <= x < b -> is_derive F x (f x)) -> (forall x, a <= x < b -> continuous f x) ->
  filterlim F (at_left b) (locally l) ->
  is_RInt_gen f (at_point a) (at_left b) (l - F a).
Proof.
  intros F f a b l H D C L. apply (integral_between F); [apply at_point_filter | apply at_left_proper_filter | | | exact L].
  - apply (Filter_prod _ _ _ (fun x => x = a) (fun y => a < y < b)); [reflexivity | |].
    + assert (N : 0 < b - a) by lra. exists (mkposreal _ N). intros y B Y.
      unfold ball in B. simpl in B. unfold AbsRing_ball, abs, minus, plus, opp in B. simpl in B.
      apply Rabs_def2 in B. lra.
    + intros x y -> Y t T. simpl in *. rewrite Rmin_left, Rmax_right in T by lra. split; [apply D | apply C]; lra.
  - intros P HP. exact (locally_singleton _ _ HP).
Qed.

(* The limits of an antiderivative that is continuous at a singular end are its values there. *)

Lemma limit_right : forall (F : R -> R) (a : R), continuous F a -> filterlim F (at_right a) (locally (F a)).
Proof.
  intros F a C P HP. destruct (C P HP) as [eps E]. exists eps. intros y B _. exact (E y B).
Qed.

Lemma limit_left : forall (F : R -> R) (b : R), continuous F b -> filterlim F (at_left b) (locally (F b)).
Proof.
  intros F b C P HP. destruct (C P HP) as [eps E]. exists eps. intros y B _. exact (E y B).
Qed.

Lemma integral_singular_left : forall (F f : R -> R) (a b : R), a < b -> continuous F a ->
  (forall x, a < x <= b -> is_derive F x (f x)) -> (forall x, a < x <= b -> continuous f x) ->
  is_RInt_gen f (at_right a) (at_point b) (F b - F a).
Proof. intros F f a b H L D C. apply integral_from_right; try assumption. now apply limit_right. Qed.

Lemma integral_singular_right : forall (F f : R -> R) (a b : R), a < b -> continuous F b ->
  (forall x, a <= x < b -> is_derive F x (f x)) -> (forall x, a <= x < b -> continuous f x) ->
  is_RInt_gen f (at_point a) (at_left b) (F b - F a).
Proof. intros F f a b H L D C. apply integral_to_left; try assumption. now apply limit_left. Qed.

Example integral_1 : RInt (fun t => t * sin t) 0 PI = PI.
Proof.
  integrate (fun t => sin t - t * cos t). rewrite sin_PI, cos_PI, sin_0, cos_0. ring.
Qed.

Example integral_2 : RInt (fun t => root 2 (1 - t ^ 2)) 0 1 = PI / 4.
Proof.
  integrate (fun t => asin t / 2 + t * sqrt (1 - t ^ 2) / 2).
  rewrite asin_1, asin_0. replace (1 - 1 ^ 2) with 0 by ring. rewrite sqrt_0. lra.
Qed.

Example integral_4 : is_RInt_gen (fun t => 1 / sqrt (1 - t ^ 2)) (at_point 0) (at_left 1) (PI / 2).
Proof.
  replace (PI / 2) with (asin 1 - asin 0) by (rewrite asin_1, asin_0; ring).
  apply integral_singular_right.
  - lra.
  - is_continuous.
  - intros x H. differentiate.
  - intros x H. is_continuous.
Qed.

Example integral_5 : is_RInt_gen (fun t => 1 / (1 + t ^ 2)) (Rbar_locally m_infty) (Rbar_locally p_infty) PI.
Proof.
  replace PI with (PI / 2 - - (PI / 2)) by field.
  apply (integral_whole_line atan).
  - intro x. differentiate.
  - intro x. is_continuous.
  - exact limit_atan_m.
  - exact limit_atan_p.
Qed.

Example integral_3 : is_RInt_gen (fun t => exp (- t)) (at_point 0) (Rbar_locally p_infty) 1.
Proof.
  replace 1 with (0 - - exp (- 0)) by (rewrite Ropp_0, exp_0; ring).
  apply (integral_to_infinity (fun t => - exp (- t))).
  - intros x _. differentiate.
  - intros x _. is_continuous.
  - replace (Finite 0) with (Rbar_opp (Finite 0)) by (simpl; f_equal; ring).
    apply (is_lim_opp (fun t => exp (- t))).
    apply (is_lim_comp exp (fun t => - t) p_infty 0 m_infty).
    + exact is_lim_exp_m.
    + apply (is_lim_opp (fun t => t) p_infty p_infty). apply is_lim_id.
    + exists 0. discriminate.
Qed.

(* Sums and products of u(n) for n from a to b; an empty one is 0, or 1. *)

Fixpoint sum_terms (u : R -> R) (a : Z) (n : nat) : R :=
  match n with
  | O => 0
  | S m => sum_terms u a m + u (IZR (a + Z.of_nat m))
  end.

Fixpoint product_terms (u : R -> R) (a : Z) (n : nat) : R :=
  match n with
  | O => 1
  | S m => product_terms u a m * u (IZR (a + Z.of_nat m))
  end.

Definition vsum (a b : Z) (u : R -> R) : R := sum_terms u a (Z.to_nat (b - a + 1)).
Definition vprod (a b : Z) (u : R -> R) : R := product_terms u a (Z.to_nat (b - a + 1)).

(* The same between ends that are real numbers with integer values. *)
Definition rsum (a b : R) (u : R -> R) : R := vsum (Int_part a) (Int_part b) u.
Definition rprod (a b : R) (u : R -> R) : R := vprod (Int_part a) (Int_part b) u.

Lemma rsum_IZR : forall (a b : Z) (u : R -> R), rsum (IZR a) (IZR b) u = vsum a b u.
Proof. intros a b u. unfold rsum. now rewrite !Int_part_IZR. Qed.

Lemma rprod_IZR : forall (a b : Z) (u : R -> R), rprod (IZR a) (IZR b) u = vprod a b u.
Proof. intros a b u. unfold rprod. now rewrite !Int_part_IZR. Qed.

(* Integers among the real numbers. *)

Lemma integer_IZR : forall z : Z, integer (IZR z).
Proof. intro z. now exists z. Qed.

Lemma integer_INR : forall n : nat, integer (INR n).
Proof. intro n. exists (Z.of_nat n). apply INR_IZR_INZ. Qed.

Lemma integer_plus : forall x y : R, integer x -> integer y -> integer (x + y).
Proof. intros x y [a ->] [b ->]. exists (a + b)%Z. now rewrite plus_IZR. Qed.

Lemma integer_minus : forall x y : R, integer x -> integer y -> integer (x - y).
Proof. intros x y [a ->] [b ->]. exists (a - b)%Z. now rewrite minus_IZR. Qed.

Lemma integer_opp : forall x : R, integer x -> integer (- x).
Proof. intros x [a ->]. exists (- a)%Z. now rewrite opp_IZR. Qed.

Lemma integer_mult : forall x y : R, integer x -> integer y -> integer (x * y).
Proof. intros x y [a ->] [b ->]. exists (a * b)%Z. now rewrite mult_IZR. Qed.

Lemma integer_pow : forall (x : R) (n : nat), integer x -> integer (x ^ n).
Proof.
  intros x n X. induction n as [| n IH]; [exact (integer_IZR 1) | now apply integer_mult].
Qed.

Ltac is_integer :=
  repeat first
  [ assumption
  | apply integer_IZR
  | apply integer_INR
  | apply integer_plus
  | apply integer_minus
  | apply integer_opp
  | apply integer_mult
  | apply integer_pow ].

Lemma integer_gap : forall x y : R, integer x -> integer y -> x < y -> x + 1 <= y.
Proof.
  intros x y [a ->] [b ->] H. apply lt_IZR in H. rewrite <- plus_IZR. apply IZR_le. lia.
Qed.

(* Induction over the integers from a on, as real numbers. *)
Lemma integer_induction : forall (P : R -> Prop) (a : R), integer a -> P a ->
  (forall n : R, integer n -> a <= n -> P n -> P (n + 1)) ->
  forall b : R, integer b -> a <= b -> P b.
Proof.
  intros P a [z ->] B Next b [w ->] L. apply le_IZR in L.
  replace w with (z + Z.of_nat (Z.to_nat (w - z)))%Z by lia.
  induction (Z.to_nat (w - z)) as [| k IH].
  - now rewrite Z.add_0_r.
  - replace (z + Z.of_nat (S k))%Z with (z + Z.of_nat k + 1)%Z by lia.
    rewrite plus_IZR. apply Next; [apply integer_IZR | apply IZR_le; lia | exact IH].
Qed.

(* Empty sums, last and first terms, parts of sums. *)

Lemma vsum_empty : forall (a b : Z) (u : R -> R), (b < a)%Z -> vsum a b u = 0.
Proof. intros a b u H. unfold vsum. now replace (Z.to_nat (b - a + 1)) with O by lia. Qed.

Lemma vprod_empty : forall (a b : Z) (u : R -> R), (b < a)%Z -> vprod a b u = 1.
Proof. intros a b u H. unfold vprod. now replace (Z.to_nat (b - a + 1)) with O by lia. Qed.

Lemma vsum_next : forall (a b : Z) (u : R -> R), (a - 1 <= b)%Z -> vsum a (b + 1) u = vsum a b u + u (IZR (b + 1)).
Proof.
  intros a b u H. unfold vsum.
  replace (Z.to_nat (b + 1 - a + 1)) with (S (Z.to_nat (b - a + 1))) by lia.
  simpl. do 3 f_equal. lia.
Qed.

Lemma vprod_next : forall (a b : Z) (u : R -> R), (a - 1 <= b)%Z -> vprod a (b + 1) u = vprod a b u * u (IZR (b + 1)).
Proof.
  intros a b u H. unfold vprod.
  replace (Z.to_nat (b + 1 - a + 1)) with (S (Z.to_nat (b - a + 1))) by lia.
  simpl. do 3 f_equal. lia.
Qed.

Lemma rsum_empty : forall (a b : R) (u : R -> R), integer a -> integer b -> b < a -> rsum a b u = 0.
Proof. intros a b u [x ->] [y ->] H. rewrite rsum_IZR. apply vsum_empty, lt_IZR, H. Qed.

Lemma rprod_empty : forall (a b : R) (u : R -> R), integer a -> integer b -> b < a -> rprod a b u = 1.
Proof. intros a b u [x ->] [y ->] H. rewrite rprod_IZR. apply vprod_empty, lt_IZR, H. Qed.

Lemma rsum_before : forall (a : R) (u : R -> R), integer a -> rsum a (a - 1) u = 0.
Proof. intros a u A. apply rsum_empty; [is_integer | is_integer | lra]. Qed.

Lemma rprod_before : forall (a : R) (u : R -> R), integer a -> rprod a (a - 1) u = 1.
Proof. intros a u A. apply rprod_empty; [is_integer | is_integer | lra]. Qed.

Lemma rsum_next : forall (a b : R) (u : R -> R), integer a -> integer b -> a - 1 <= b ->
  rsum a (b + 1) u = rsum a b u + u (b + 1).
Proof.
  intros a b u [x ->] [y ->] H. rewrite <- minus_IZR in H. apply le_IZR in H.
  rewrite <- plus_IZR, !rsum_IZR. now apply vsum_next.
Qed.

Lemma rprod_next : forall (a b : R) (u : R -> R), integer a -> integer b -> a - 1 <= b ->
  rprod a (b + 1) u = rprod a b u * u (b + 1).
Proof.
  intros a b u [x ->] [y ->] H. rewrite <- minus_IZR in H. apply le_IZR in H.
  rewrite <- plus_IZR, !rprod_IZR. now apply vprod_next.
Qed.

Lemma rsum_last : forall (a b : R) (u : R -> R), integer a -> integer b -> a <= b ->
  rsum a b u = rsum a (b - 1) u + u b.
Proof.
  intros a b u A B H. replace b with (b - 1 + 1) at 1 3 by ring.
  apply rsum_next; [is_integer | is_integer | lra].
Qed.

Lemma rprod_last : forall (a b : R) (u : R -> R), integer a -> integer b -> a <= b ->
  rprod a b u = rprod a (b - 1) u * u b.
Proof.
  intros a b u A B H. replace b with (b - 1 + 1) at 1 3 by ring.
  apply rprod_next; [is_integer | is_integer | lra].
Qed.

Lemma rsum_one : forall (a : R) (u : R -> R), integer a -> rsum a a u = u a.
Proof.
  intros a u A. rewrite rsum_last, rsum_before by (try assumption; lra). ring.
Qed.

Lemma rprod_one : forall (a : R) (u : R -> R), integer a -> rprod a a u = u a.
Proof.
  intros a u A. rewrite rprod_last, rprod_before by (try assumption; lra). ring.
Qed.

(* From the integer before the first term on: what holds of the empty sum and is kept by each term holds. *)
Lemma rsum_induction : forall (P : R -> R -> Prop) (a : R) (u : R -> R), integer a -> P (a - 1) 0 ->
  (forall n s : R, integer n -> a - 1 <= n -> P n s -> P (n + 1) (s + u (n + 1))) ->
  forall b : R, integer b -> a - 1 <= b -> P b (rsum a b u).
Proof.
  intros P a u A Z S. apply (integer_induction (fun b => P b (rsum a b u)) (a - 1)).
  - is_integer.
  - now rewrite rsum_before.
  - intros n N L H. rewrite rsum_next by assumption. now apply S.
Qed.

Lemma rprod_induction : forall (P : R -> R -> Prop) (a : R) (u : R -> R), integer a -> P (a - 1) 1 ->
  (forall n s : R, integer n -> a - 1 <= n -> P n s -> P (n + 1) (s * u (n + 1))) ->
  forall b : R, integer b -> a - 1 <= b -> P b (rprod a b u).
Proof.
  intros P a u A Z S. apply (integer_induction (fun b => P b (rprod a b u)) (a - 1)).
  - is_integer.
  - now rewrite rprod_before.
  - intros n N L H. rewrite rprod_next by assumption. now apply S.
Qed.

(* Closed forms. *)

Lemma rsum_closed : forall (F u : R -> R) (a b : R), integer a -> integer b -> a - 1 <= b ->
  F (a - 1) = 0 ->
  (forall n : R, integer n -> a - 1 <= n -> n + 1 <= b -> F (n + 1) - F n = u (n + 1)) ->
  rsum a b u = F b.
Proof.
  intros F u a b A B L Z S.
  apply (integer_induction (fun c => c <= b -> rsum a c u = F c) (a - 1)); try assumption; [| | | lra].
  - is_integer.
  - intros _. now rewrite rsum_before.
  - intros n N K IH Q. rewrite rsum_next by assumption. rewrite IH by lra. rewrite <- S by assumption. ring.
Qed.

Lemma rsum_telescope : forall (F u : R -> R) (a b : R), integer a -> integer b -> a - 1 <= b ->
  (forall n : R, integer n -> a - 1 <= n -> n + 1 <= b -> F (n + 1) - F n = u (n + 1)) ->
  rsum a b u = F b - F (a - 1).
Proof.
  intros F u a b A B L S. apply (rsum_closed (fun n => F n - F (a - 1))); try assumption.
  - ring.
  - intros n N K Q. rewrite <- S by assumption. ring.
Qed.

(* The same with differences of the form F(n + 1) - F(n) = u(n), as Gosper's algorithm gives them. *)
Lemma rsum_differences : forall (F u : R -> R) (a b : R), integer a -> integer b -> a - 1 <= b ->
  (forall n : R, integer n -> a <= n -> n <= b -> F (n + 1) - F n = u n) ->
  rsum a b u = F (b + 1) - F a.
Proof.
  intros F u a b A B L S.
  rewrite (rsum_telescope (fun n => F (n + 1)) u a b A B L).
  - replace (a - 1 + 1) with a by ring. reflexivity.
  - intros n N K Q. apply S; [is_integer | lra | lra].
Qed.

Lemma rprod_closed : forall (F u : R -> R) (a b : R), integer a -> integer b -> a - 1 <= b ->
  F (a - 1) = 1 ->
  (forall n : R, integer n -> a - 1 <= n -> n + 1 <= b -> F (n + 1) = F n * u (n + 1)) ->
  rprod a b u = F b.
Proof.
  intros F u a b A B L Z S.
  apply (integer_induction (fun c => c <= b -> rprod a c u = F c) (a - 1)); try assumption; [| | | lra].
  - is_integer.
  - intros _. now rewrite rprod_before.
  - intros n N K IH Q. rewrite rprod_next by assumption. rewrite IH by lra. now rewrite <- S by assumption.
Qed.

(* Equal terms, linearity, parts. *)

Lemma rsum_equal : forall (u v : R -> R) (a b : R), integer a -> integer b ->
  (forall n : R, integer n -> a <= n <= b -> u n = v n) -> rsum a b u = rsum a b v.
Proof.
  intros u v a b A B E. destruct (Rlt_dec b a) as [H | H].
  - now rewrite !rsum_empty.
  - apply (rsum_closed (fun n => rsum a n v)); try assumption; [lra | now apply rsum_before |].
    intros n N K Q. rewrite rsum_next by assumption. rewrite E; [ring | is_integer | lra].
Qed.

Lemma rprod_equal : forall (u v : R -> R) (a b : R), integer a -> integer b ->
  (forall n : R, integer n -> a <= n <= b -> u n = v n) -> rprod a b u = rprod a b v.
Proof.
  intros u v a b A B E. destruct (Rlt_dec b a) as [H | H].
  - now rewrite !rprod_empty.
  - apply (rprod_closed (fun n => rprod a n v)); try assumption; [lra | now apply rprod_before |].
    intros n N K Q. rewrite rprod_next by assumption. rewrite E; [ring | is_integer | lra].
Qed.

Lemma sum_terms_plus : forall (u v : R -> R) (a : Z) (n : nat),
  sum_terms (fun t => u t + v t) a n = sum_terms u a n + sum_terms v a n.
Proof. intros u v a n. induction n as [| n IH]; simpl; [ring | rewrite IH; ring]. Qed.

Lemma sum_terms_minus : forall (u v : R -> R) (a : Z) (n : nat),
  sum_terms (fun t => u t - v t) a n = sum_terms u a n - sum_terms v a n.
Proof. intros u v a n. induction n as [| n IH]; simpl; [ring | rewrite IH; ring]. Qed.

Lemma sum_terms_scal : forall (c : R) (u : R -> R) (a : Z) (n : nat),
  sum_terms (fun t => c * u t) a n = c * sum_terms u a n.
Proof. intros c u a n. induction n as [| n IH]; simpl; [ring | rewrite IH; ring]. Qed.

Lemma product_terms_mult : forall (u v : R -> R) (a : Z) (n : nat),
  product_terms (fun t => u t * v t) a n = product_terms u a n * product_terms v a n.
Proof. intros u v a n. induction n as [| n IH]; simpl; [ring | rewrite IH; ring]. Qed.

Lemma rsum_plus : forall (a b : R) (u v : R -> R), rsum a b (fun t => u t + v t) = rsum a b u + rsum a b v.
Proof. intros a b u v. apply sum_terms_plus. Qed.

Lemma rsum_minus : forall (a b : R) (u v : R -> R), rsum a b (fun t => u t - v t) = rsum a b u - rsum a b v.
Proof. intros a b u v. apply sum_terms_minus. Qed.

Lemma rsum_scal : forall (a b c : R) (u : R -> R), rsum a b (fun t => c * u t) = c * rsum a b u.
Proof. intros a b c u. apply sum_terms_scal. Qed.

Lemma rsum_opp : forall (a b : R) (u : R -> R), rsum a b (fun t => - u t) = - rsum a b u.
Proof.
  intros a b u. unfold rsum, vsum. induction (Z.to_nat _) as [| n IH]; simpl; [ring | rewrite IH; ring].
Qed.

Lemma rsum_scal_r : forall (a b c : R) (u : R -> R), rsum a b (fun t => u t * c) = rsum a b u * c.
Proof.
  intros a b c u. unfold rsum, vsum. induction (Z.to_nat _) as [| n IH]; simpl; [ring | rewrite IH; ring].
Qed.

Lemma rsum_div : forall (a b c : R) (u : R -> R), rsum a b (fun t => u t / c) = rsum a b u / c.
Proof. intros a b c u. exact (rsum_scal_r a b (/ c) u). Qed.

Lemma rprod_mult : forall (a b : R) (u v : R -> R), rprod a b (fun t => u t * v t) = rprod a b u * rprod a b v.
Proof. intros a b u v. apply product_terms_mult. Qed.

Lemma rsum_const : forall a b c : R, integer a -> integer b -> a - 1 <= b ->
  rsum a b (fun _ => c) = (b - a + 1) * c.
Proof.
  intros a b c A B L. apply (rsum_closed (fun n => (n - a + 1) * c)); try assumption; [ring | intros; ring].
Qed.

Lemma rsum_split : forall (a b c : R) (u : R -> R), integer a -> integer b -> integer c -> a - 1 <= b -> b <= c ->
  rsum a c u = rsum a b u + rsum (b + 1) c u.
Proof.
  intros a b c u A B C L M.
  assert (S : rsum (b + 1) c u = rsum a c u - rsum a b u).
  { rewrite (rsum_telescope (fun n => rsum a n u) u (b + 1) c); try is_integer; try lra.
    - now replace (b + 1 - 1) with b by ring.
    - intros n N K Q. rewrite rsum_next; [ring | exact A | exact N | lra]. }
  rewrite S. ring.
Qed.

Lemma rsum_first : forall (a b : R) (u : R -> R), integer a -> integer b -> a <= b ->
  rsum a b u = u a + rsum (a + 1) b u.
Proof.
  intros a b u A B L. rewrite (rsum_split a a b u) by (try assumption; lra). now rewrite rsum_one.
Qed.

Lemma rsum_shift : forall (a b k : R) (u : R -> R), integer a -> integer b -> integer k -> a - 1 <= b ->
  rsum (a + k) (b + k) u = rsum a b (fun t => u (t + k)).
Proof.
  intros a b k u A B K L. symmetry.
  apply (rsum_closed (fun n => rsum (a + k) (n + k) u)); try assumption.
  - replace (a - 1 + k) with (a + k - 1) by ring. apply rsum_before. is_integer.
  - intros n N M Q. replace (n + 1 + k) with (n + k + 1) by ring.
    rewrite rsum_next; [ring | is_integer | is_integer | lra].
Qed.

Lemma rprod_nonzero : forall (a b : R) (u : R -> R), integer a -> integer b -> a - 1 <= b ->
  (forall n : R, integer n -> a <= n <= b -> u n <> 0) -> rprod a b u <> 0.
Proof.
  intros a b u A B L N.
  apply (integer_induction (fun c => c <= b -> rprod a c u <> 0) (a - 1)); try assumption; [| | | lra].
  - is_integer.
  - intros _. rewrite rprod_before by assumption. lra.
  - intros n I K IH Q. rewrite rprod_next by assumption. apply Rmult_integral_contrapositive_currified.
    + apply IH. lra.
    + apply N; [is_integer | lra].
Qed.

(* Sums of the standard form of series, and infinite sums as limits. *)

Lemma vsum_sum_n : forall (u : R -> R) (n : nat), vsum 0 (Z.of_nat n) u = sum_n (fun k => u (INR k)) n.
Proof.
  intros u n. unfold vsum. replace (Z.to_nat (Z.of_nat n - 0 + 1)) with (S n) by lia.
  induction n as [| n IH].
  - rewrite sum_O. simpl. ring.
  - rewrite sum_Sn, <- IH. simpl sum_terms at 1. unfold plus. simpl plus. rewrite INR_IZR_INZ. reflexivity.
Qed.

Lemma vsum_infinite : forall (F u : R -> R) (a : Z) (l : R),
  (forall n : R, integer n -> IZR a <= n -> F (n + 1) - F n = u n) -> is_lim F p_infty l ->
  is_lim_seq (fun n => vsum a (Z.of_nat n) u) (l - F (IZR a)).
Proof.
  intros F u a l S L.
  apply (is_lim_seq_ext_loc (fun n => F (INR n + 1) - F (IZR a))).
  - exists (Z.to_nat a). intros n N.
    rewrite <- rsum_IZR, (rsum_differences F u).
    + now rewrite <- INR_IZR_INZ.
    + is_integer.
    + is_integer.
    + rewrite <- minus_IZR. apply IZR_le. lia.
    + intros m M K _. now apply S.
  - apply is_lim_seq_minus'; [| apply is_lim_seq_const].
    apply (is_lim_comp_seq F (fun n => INR n + 1) p_infty l L).
    + exists O. discriminate.
    + apply (is_lim_seq_plus _ _ p_infty 1); [apply is_lim_seq_INR | apply is_lim_seq_const | reflexivity].
Qed.

(* Written-out sums and products, term by term. *)

Ltac whole z :=
  lazymatch z with
  | Z0 => idtac
  | Zpos _ => idtac
  | Zneg _ => idtac
  end.

Ltac unroll :=
  rewrite ?rsum_IZR, ?rprod_IZR;
  repeat match goal with
  | |- context [vsum ?a ?b ?u] =>
    let n := eval compute in (Z.to_nat (b - a + 1)) in
    change (vsum a b u) with (sum_terms u a n)
  | |- context [vprod ?a ?b ?u] =>
    let n := eval compute in (Z.to_nat (b - a + 1)) in
    change (vprod a b u) with (product_terms u a n)
  end;
  cbn [sum_terms product_terms];
  repeat match goal with
  | |- context [IZR (?a + Z.of_nat ?m)] =>
    let z := eval compute in (a + Z.of_nat m)%Z in
    whole z; change (a + Z.of_nat m)%Z with z
  end;
  cbv beta.

Example unroll_1 : rsum 1 5 (fun n => n ^ 2) = 55.
Proof. unroll. ring. Qed.

Example unroll_2 : rprod 1 5 (fun n => n) + rsum (-2) 2 (fun n => n) + vsum 3 2 (fun n => n) = 120.
Proof. unroll. ring. Qed.

Example sum_1 : forall n : R, integer n -> n >= 0 -> rsum 1 n (fun k => k ^ 3) = (n * (n + 1) / 2) ^ 2.
Proof.
  intros n N P. apply (rsum_closed (fun n => (n * (n + 1) / 2) ^ 2)); [is_integer | is_integer | lra | field | intros; field].
Qed.

Example sum_2 : forall n x : R, integer n -> n >= 0 -> x <> 1 -> rsum 0 n (fun k => rpow x k) = (1 - rpow x (n + 1)) / (1 - x).
Proof.
  intros n x N P X. apply (rsum_closed (fun n => (1 - rpow x (n + 1)) / (1 - x))); [is_integer | is_integer | lra | |].
  - replace (0 - 1 + 1) with (IZR 0) by ring. rewrite rpow_IZR. simpl. field. lra.
  - intros m M L _. rewrite (PowerOfSum x (m + 1 + 1) (m + 1) 1); [| ring | is_integer | is_integer | lra | lra].
    rewrite (rpow_IZR x 1). simpl. field. lra.
Qed.
